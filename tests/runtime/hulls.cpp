// SPDX-License-Identifier: BSL-1.0
// Convex hulls in scene files, where Sinew is built with libccd: the bits of the typed scene.

#include "same_bits.hpp"

namespace test_hulls {

#ifdef SINEW_CCD

using namespace sinew;
using same_bits::bits_of;

namespace {

constexpr double dt = 0.005;

constexpr std::string_view head = R"(<Node name="root" dt="0.005" gravity="0 0 -9.81">
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.02"/> <DefaultContactManager/>)";

std::string scene(std::string_view hull) {
  return text(head,
              R"(
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject template="Vec3d" position="-5 -5 0  5 -5 0  5 5 0  -5 5 0"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="100" contactFriction="0.3"/>
  </Node>
  <Node name="bodies">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-10" threshold="0"/>
    <MechanicalObject template="Rigid3d" position="0 0 0.4  0.2 0.1 0 0.97467943448089633  0.1 0.1 0.9  0 0 0 1"/>
    <UniformMass vertexMass="1 1  0.05 0 0  0 0.05 0  0 0 0.05"/>)",
              hull,
              R"(
  </Node>
</Node>)");
}
constexpr std::string_view tetrahedron = R"(
    <ConvexCollisionModel selfCollision="1" contactStiffness="100" contactDamping="3" contactFriction="0.2"
                          points="-0.3 -0.3 -0.2  0.4 -0.3 -0.2  0 0.4 -0.2  0 0 0.3"/>)";

auto typed() {
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  RigidCoord3<double> first{{0, 0, 0.4}, {0.97467943448089633, 0.2, 0.1, 0}},
      second{{0.1, 0.1, 0.9}, {1, 0, 0, 0}};
  return Simulation{node<"root">(
      Gravity{{0, 0, -9.81}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.02},
      DefaultContactManager{},
      node<"floor">(
          topology,
          MechanicalObject<Vec3d>{.position = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}},
          TriangleCollisionModel<Vec3d>{
              .moving = false, .simulated = false, .contactStiffness = 100, .contactFriction = 0.3}),
      node<"bodies">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 50, .tolerance = 1e-10},
          MechanicalObject<Rigid3d>{.position = {first, second}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, 0.05 * Eigen::Matrix3d::Identity()}},
          ConvexCollisionModel<Rigid3d>{
              .selfCollision = true,
              .contactStiffness = 100,
              .contactFriction = 0.2,
              .contactDamping = 3,
              .points = {{-0.3, -0.3, -0.2}, {0.4, -0.3, -0.2}, {0, 0.4, -0.2}, {0, 0, 0.3}}}))};
}

}  // namespace

TEST_CASE(
    "hulls of a scene file give the bits of the typed scene, go on from a checkpoint, and start again") {
  auto run = start(parse_scene<Standard>("hulls.scn", scene(tetrahedron)));
  auto same = typed();
  same.init();
  std::string early;
  for (int i = 0; i < 200; ++i) {
    run.animate(dt), same.animate(dt);
    if (i == 99) early = bits_of(run);
  }
  CHECK(run.root().get<DefaultContactManager>()->contacts.size() >= 3);
  CHECK(bits_of(run) == bits_of(same));
  auto again = start(parse_scene<Standard>("saved.scn", scene_text(run, dt)));
  for (int i = 0; i < 100; ++i) run.animate(dt), same.animate(dt), again.animate(dt);
  CHECK(bits_of(run) == bits_of(same));
  CHECK(bits_of(again) == bits_of(same));
  run.reset(), again.reset();
  for (int i = 0; i < 100; ++i) run.animate(dt), again.animate(dt);
  CHECK(bits_of(run) == early);
  CHECK(bits_of(again) == early);
  // no hull below the floor of the scene, or a ray through one
  const auto pick =
      run.pick({run.root().find_node("bodies")->get<MechanicalObject<Rigid3d>>()->position[1].center +
                Eigen::Vector3d(0, 0, 5)},
               {0, 0, -1});
  REQUIRE(pick);
  CHECK(pick->distance < 5);
}

TEST_CASE("a hull has the names of SOFA's plugin for Bullet, and the points of a loader") {
  const std::string own = scene(tetrahedron);
  auto hull = [](auto read) {
    return read.root.find_node("bodies")->template get<ConvexCollisionModel<Rigid3d>>()->points;
  };
  const auto points = hull(parse_scene<Standard>("hulls.scn", own));
  CHECK(points.size() == 4);
  CHECK(hull(parse_scene<Standard>("hulls.scn", scene(R"(<BulletConvexHullModel
                 CHPoints="-0.3 -0.3 -0.2  0.4 -0.3 -0.2  0 0.4 -0.2  0 0 0.3"/>)"))) == points);
  CHECK(hull(parse_scene<Standard>("hulls.scn",
                                   scene(R"(<RegularGridTopology name="grid" n="2 2 2" max="1 1 1"/>
    <ConvexCollisionModel position="@grid.position"/>)")))
            .size() == 8);
}

TEST_CASE("a floor so large that places on it are no numbers is said, and not touched") {
  std::string large = scene(tetrahedron);
  const std::string_view flat = "-5 -5 0  5 -5 0  5 5 0  -5 5 0";
  large.replace(large.find(flat), flat.size(), "-5 -5 9e18  5 -1e300 0  5 5 0  -5 5 0");
  auto sim = start(parse_scene<Standard>("large.scn", large));
  REQUIRE_THROWS_WITH(
      sim.animate(dt),
      Catch::Contains("/root/floor: places on element 0 of its collision model are not finite"));
}

TEST_CASE("a hull without points, or of a file that is not there, is said with its place") {
  auto refused = [](std::string_view hull, std::string_view words) {
    CHECK_THROWS_WITH(start(parse_scene<Standard>("hulls.scn", scene(hull))),
                      Catch::Contains(std::string(words)));
  };
  refused("<ConvexCollisionModel/>", "there are no points to make a hull of");
  refused("<ConvexCollisionModel filename='no/such.obj'/>", "no/such.obj");
  refused("<ConvexCollisionModel points='0 0'/>", "points");
  refused("<ConvexCollisionModel template='Vec3d' points='0 0 0'/>", "Rigid3d");
}

TEST_CASE("a scene with hulls is baked with their header") {
  const std::string cpp = bake_text(parse_scene<Standard>("hulls.scn", scene(tetrahedron)), "hulls.scn");
  CHECK(cpp.find("#include <sinew/collision/convex_collision_model.hpp>") != cpp.npos);
  CHECK(cpp.find("ConvexCollisionModel<Rigid3d>{") != cpp.npos);
}

#endif

}  // namespace test_hulls
