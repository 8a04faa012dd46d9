// SPDX-License-Identifier: BSL-1.0
// Contacts in a runtime tree read from a file, and in the typed scene: the same bits.

#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_contact {

using namespace sinew;

namespace {

constexpr std::string_view scene = R"(
<Node name="root" dt="0.01" gravity="0 0 -10">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.2" contactDistance="0.1"/>
  <CollisionResponse response="PenalityContactForceField"/>
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject template="Vec3d" position="-10 -10 0  10 -10 0  10 10 0  -10 10 0"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="1000" contactFriction="0.2"/>
  </Node>
  <Node name="balls">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="25" tolerance="1e-9" threshold="0"/>
    <MechanicalObject template="Vec3d" position="0 0.3 0.65  0.2 0.1 1.7" velocity="0.5 0 0  0 0 0"/>
    <UniformMass vertexMass="2"/>
    <SphereCollisionModel selfCollision="true" radius="0.5" contactStiffness="100" contactDamping="5"/>
  </Node>
</Node>)";

template <class LinearSolver>
auto typed(LinearSolver linear) {
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  return Simulation{node<"root">(
      Gravity{{0, 0, -10}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1},
      DefaultContactManager{},
      node<"floor">(
          topology,
          MechanicalObject<Vec3d>{.position = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}},
          TriangleCollisionModel<Vec3d>{
              .moving = false, .simulated = false, .contactStiffness = 1000, .contactFriction = 0.2}),
      node<"balls">(
          EulerImplicitSolver{},
          linear,
          MechanicalObject<Vec3d>{.position = {{0, 0.3, 0.65}, {0.2, 0.1, 1.7}},
                                  .velocity = {{0.5, 0, 0}, {0, 0, 0}}},
          UniformMass<Vec3d>{.vertexMass = 2},
          SphereCollisionModel<Vec3d>{
              .selfCollision = true, .contactStiffness = 100, .contactDamping = 5, .radius = 0.5}))};
}

}  // namespace

// the same bits for 300 steps
template <class LinearSolver>
void compare(std::string const& content, LinearSolver linear) {
  auto read = parse_scene<Standard>("balls.scn", content);
  Simulation sim{std::move(read.root)};
  auto fixed = typed(linear);
  sim.init();
  fixed.init();
  std::size_t maximum = 0;
  for (int i = 0; i < 300; ++i) {
    sim.animate(0.01);
    fixed.animate(0.01);
    maximum = std::max(maximum, fixed.root().template get<DefaultContactManager>().contacts.size());
    auto& state = *sim.root().find_node("balls")->template get<MechanicalObject<Vec3d>>();
    REQUIRE(state.position == fixed.template at<"balls">().state().position);
  }
  CHECK(maximum == 2);
}

TEST_CASE("contacts in a scene file and in a typed scene: the same bits") {
  compare(std::string(scene), CGLinearSolver<>{.iterations = 25, .tolerance = 1e-9});
}

TEST_CASE("contacts in the matrix of a direct solver, in a scene file and in a typed scene: the same bits") {
  std::string direct(scene);
  const std::size_t at = direct.find("<CGLinearSolver");
  direct.replace(
      at, direct.find("/>", at) - at, R"(<SparseLDLSolver template="CompressedRowSparseMatrixMat3x3d")");
  compare(direct, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{});
}

TEST_CASE("what is above a thin plate is not drawn through it by the face behind") {
  // the lower face comes into reach first, at 3.8 m; the upper one pushes from 3 m on
  auto sim = start(parse_scene<Standard>("plate.scn", R"(
<Node name="root" gravity="0 0 -10">
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/> <DefaultContactManager/>
  <MinProximityIntersection alarmDistance="3" contactDistance="2"/>
  <Node name="plate">
    <MeshTopology hexahedra="0 1 2 3 4 5 6 7"/>
    <MechanicalObject template="Vec3d" position="-9 -9 -0.2  9 -9 -0.2  9 9 -0.2  -9 9 -0.2  -9 -9 0  9 -9 0  9 9 0  -9 9 0"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="500"/>
  </Node>
  <Node name="balls">
    <EulerImplicitSolver/> <CGLinearSolver iterations="25" tolerance="1e-12" threshold="0"/>
    <MechanicalObject template="Vec3d" position="0.5 0.2 3.95  1 1 3.95"/> <UniformMass vertexMass="2"/>
    <SphereCollisionModel radius="1"/>
  </Node>
</Node>)"));
  auto const& balls = sim.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->position;
  const double dt = 0.01;
  for (int i = 1; i <= 200; ++i) {
    sim.animate(dt);
    for (auto const& ball : balls) {
      if (const double free = 3.95 - 10 * dt * dt * i * (i + 1) / 2; free > 3.1)
        CHECK(ball.z() == Approx(free).epsilon(1e-12));
      CHECK(ball.z() > 1);
    }
  }
}

TEST_CASE("a collision model without a pipeline is said to collide with nothing") {
  RuntimeNode<Standard> root("root");
  root.add(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}});
  root.add(SphereCollisionModel<Vec3d>{});
  Simulation sim{std::move(root)};
  sim.init();
  REQUIRE(sim.root().warnings.size() == 1);
  CHECK_THAT(sim.root().warnings[0],
             Catch::Contains("DefaultPipeline") && Catch::Contains("SphereCollisionModel"));
}

TEST_CASE("a stage that is missing, and a response that there is not, are named") {
  RuntimeNode<Standard> root("root");
  root.add(DefaultPipeline{});
  root.add(BruteForceBroadPhase{});
  root.add(MinProximityIntersection{});
  SECTION("narrow phase") {
    root.add(DefaultContactManager{});
    CHECK_THROWS_WITH((Simulation{std::move(root)}.init()),
                      Catch::Contains("narrow phase") && Catch::Contains("BVHNarrowPhase"));
  }
  SECTION("response") {
    root.add(BVHNarrowPhase{});
    root.add(DefaultContactManager{.response = "Nothing"});
    CHECK_THROWS_WITH((Simulation{std::move(root)}.init()),
                      Catch::Contains("'Nothing'") && Catch::Contains("PenalityContactForceField"));
  }
}

TEST_CASE("a checkpoint in the middle of contacts with friction goes on bit by bit") {
  auto read = parse_scene<Standard>("balls.scn", std::string(scene));
  Simulation sim{std::move(read.root)};
  sim.init();
  for (int i = 0; i < 60; ++i) sim.animate(0.01);
  REQUIRE(!sim.root().get<DefaultContactManager>()->contacts.empty());
  auto again = parse_scene<Standard>("checkpoint.scn", scene_text(sim, 0.01));
  Simulation other{std::move(again.root)};
  other.init();
  for (int i = 0; i < 100; ++i) {
    sim.animate(0.01);
    other.animate(0.01);
    REQUIRE(other.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->position ==
            sim.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->position);
  }
}

TEST_CASE("contacts of a checkpoint that are not of its scene are refused") {
  RuntimeNode<Standard> root("root");
  root.add(DefaultPipeline{});
  root.add(BruteForceBroadPhase{});
  root.add(BVHNarrowPhase{});
  root.add(MinProximityIntersection{});
  DefaultContactManager manager;
  manager.contacts.resize(1);
  manager.contacts[0].a.surface = 7;
  root.add(manager);
  CHECK_THROWS_WITH((Simulation{std::move(root)}.init()), Catch::Contains("checkpoint"));
}

TEST_CASE("a collision model is over what the state is over") {
  auto read =
      parse_scene<Standard>("rigid.scn", R"(<Node><DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/>
    <MinProximityIntersection/><DefaultContactManager/>
    <Node name="ball"><MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1"/><SphereCollisionModel radius="0.5"/></Node></Node>)");
  CHECK(read.root.find_node("ball")->get<SphereCollisionModel<Rigid3d>>());
}

}  // namespace test_contact
