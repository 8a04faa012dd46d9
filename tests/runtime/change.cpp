// SPDX-License-Identifier: BSL-1.0
// Runtime trees that change while they run.
#include "same_bits.hpp"

namespace test_change {

using namespace sinew;
using same_bits::bits_of;

namespace {

RuntimeNode<Standard> ball(std::string name, double x) {
  RuntimeNode<Standard> node(std::move(name));
  node.add(MechanicalObject<Vec3d>{.position = {{x, 0, 0}, {x, 1, 0}}});
  node.add(UniformMass<Vec3d>{.vertexMass = 1});
  node.add(
      StiffSpringForceField<Vec3d>{.springs = {{.first = 0, .second = 1, .stiffness = 50, .length = 0.8}}});
  return node;
}

StandardSimulation world() {
  RuntimeNode<Standard> root;
  root.add(Gravity{});
  root.add(EulerImplicitSolver{});
  root.add(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 50, .tolerance = 1e-12});
  root.addChild(ball("a", 0));
  StandardSimulation sim(std::move(root));
  sim.init();
  return sim;
}

MechanicalObject<Vec3d>& state(StandardSimulation& sim, std::string_view path) {
  return *sim.root().find_node(path)->get<MechanicalObject<Vec3d>>();
}

/// The message of a change that must fail, after a check that it changed nothing.
template <class F>
std::string refused(StandardSimulation& sim, F&& edit) {
  const std::string before = bits_of(sim);
  const std::size_t children = sim.root().children().size();
  std::string message;
  try {
    sim.change(edit);
  } catch (Error const& error) {
    message = error.what();
  }
  CHECK(bits_of(sim) == before);
  CHECK(sim.root().children().size() == children);
  auto copy = sim;
  sim.animate(0.01);
  copy.animate(0.01);
  CHECK(bits_of(sim) == bits_of(copy));
  return message;
}

}  // namespace

TEST_CASE("a node that is added joins the simulation, and the others go on as if nothing had happened") {
  auto sim = world(), alone = world();
  for (int i = 0; i < 20; ++i) sim.animate(0.01), alone.animate(0.01);
  sim.change([](auto& root) { root.addChild(ball("b", 5)); });
  CHECK(sim.time() == alone.time());
  for (int i = 0; i < 20; ++i) sim.animate(0.01), alone.animate(0.01);
  // both bodies fall by the same recurrence; CG couples them through its step lengths, to its tolerance
  CHECK((state(sim, "a").position[0] - state(alone, "a").position[0]).norm() < 1e-9);
  const double dt = 0.01, fall = -9.81 * dt * dt * (20 * 21 / 2);
  CHECK(0.5 * (state(sim, "b").position[0].y() + state(sim, "b").position[1].y()) ==
        Approx(0.5 + fall).margin(1e-9));
}

TEST_CASE("a node that is removed leaves the others what they were") {
  auto sim = world(), alone = world();
  sim.change([](auto& root) { root.addChild(ball("b", 5)); });
  sim.change([](auto& root) { root.takeChild(*root.find_node("b")); });
  for (int i = 0; i < 20; ++i) sim.animate(0.01), alone.animate(0.01);
  CHECK(bits_of(sim) == bits_of(alone));
}

TEST_CASE("components come and go") {
  auto sim = world();
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  const Eigen::Vector3d held = state(sim, "a").position[0];
  sim.change([](auto& root) {
    root.find_node("a")->add(FixedConstraint<Vec3d>{.indices = {0}});
    root.find_node("a")->template get<MechanicalObject<Vec3d>>()->velocity[0].setZero();
  });
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  CHECK((state(sim, "a").position[0] - held).norm() < 1e-12);
  sim.change([](auto& root) { root.find_node("a")->remove("FixedConstraint"); });
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  CHECK(state(sim, "a").position[0].y() < held.y() - 1e-4);
}

TEST_CASE("a node moves to another parent and follows that") {
  RuntimeNode<Standard> root;
  for (std::string name : {"left", "right"}) {
    auto& body = root.addChild(name);
    body.add(MechanicalObject<Rigid3d>{.position = {{.center = {name == "left" ? -1. : 1., 0, 0}}}});
    body.add(UniformMass<Rigid3d>{});
  }
  auto& tip = root.find_node("left")->addChild("tip");
  tip.add(MechanicalObject<Vec3d>{.position = {{0, 2, 0}}});
  tip.add(RigidMapping<Rigid3d, Vec3d>{});
  tip.add(ConstantForceField<Vec3d>{.indices = {0}, .forces = {{0, 0, 3}}});
  root.add(EulerExplicitSolver{});
  StandardSimulation sim(std::move(root));
  sim.init();
  CHECK(state(sim, "left/tip").position[0] == Eigen::Vector3d(-1, 2, 0));
  sim.animate(0.01);
  sim.change([](auto& r) {
    auto& left = *r.find_node("left");
    r.find_node("right")->addChild(left.takeChild(*left.find_node("tip")));
  });
  CHECK(state(sim, "right/tip").position[0] == Eigen::Vector3d(1, 2, 0));
  sim.animate(0.01);
  CHECK(sim.root().find_node("right")->get<MechanicalObject<Rigid3d>>()->velocity[0][2] == Approx(0.03));
}

TEST_CASE("a change that is wrong is refused whole") {
  auto sim = world();
  sim.animate(0.01);
  CHECK_THAT(refused(sim, [](auto& root) { root.addChild("empty").add(UniformMass<Vec3d>{}); }),
             Catch::Contains("/root/empty: UniformMass<Vec3d>: has no state to act on"));
  CHECK_THAT(refused(sim, [](auto& root) { root.find_node("a")->remove("MechanicalObject"); }),
             Catch::Contains("has no state to act on"));
  CHECK_THAT(
      refused(sim, [](auto& root) { root.find_node("a")->add(FixedConstraint<Vec3d>{.indices = {7}}); }),
      Catch::Contains("indices has 7, but the state has 2 points"));
  CHECK_THAT(refused(sim, [](auto& root) { root.find_node("a")->add(ConstantForceField<Vec3f>{}); }),
             Catch::Contains("other DataTypes than the state on which it acts (Vec3f on Vec3d)"));
  CHECK_THAT(refused(sim, [](auto& root) { root.addChild(ball("a", 2)); }),
             Catch::Contains("two children of the same name ('a')"));
  CHECK_THAT(refused(sim, [](auto& root) { root.remove("CGLinearSolver"); }),
             Catch::Contains("finds no linear solver"));
  CHECK_THAT(refused(sim, [](auto& root) { root.find_node("a")->add(MechanicalObject<Vec3d>{}); }),
             Catch::Contains("is the second state of its node"));
  CHECK_THAT(
      refused(sim,
              [](auto& root) {
                root.add(StiffSpringForceField<Vec3d, Linked>{.springs = {{}}, .ends = {"a", "nowhere"}});
              }),
      Catch::Contains("joins a node that is not there (object2 at 'nowhere')"));
  CHECK_THAT(refused(sim, [](auto&) { throw Error("mine", "I changed my mind"); }),
             Catch::Contains("I changed my mind"));
  // all that is wrong is said at once
  const std::string both = refused(sim, [](auto& root) {
    root.find_node("a")->add(FixedConstraint<Vec3d>{.indices = {7}}, "first");
    root.find_node("a")->add(FixedConstraint<Vec3d>{.indices = {8}}, "second");
  });
  CHECK_THAT(both, Catch::Contains("indices has 7") && Catch::Contains("indices has 8"));
}

TEST_CASE("what an interaction needs cannot be taken from it") {
  auto sim = world();
  sim.change([](auto& root) {
    root.addChild(ball("b", 3));
    root.add(StiffSpringForceField<Vec3d, Linked>{.springs = {{.first = 0, .second = 0, .length = 1}},
                                                  .ends = {"a", "b"}});
  });
  sim.animate(0.01);
  CHECK_THAT(refused(sim, [](auto& root) { root.takeChild(*root.find_node("b")); }),
             Catch::Contains("joins a node that is not there (object2 at 'b')"));
  // the two are pulled together
  CHECK(state(sim, "a").position[0].x() > 0);
  CHECK(state(sim, "b").position[0].x() < 3);
}

TEST_CASE("a hundred bodies come and go at random, and the scene equals one composed afresh") {
  auto sim = world();
  std::vector<int> present;
  unsigned seed = 7;
  for (int i = 0; i < 100; ++i) {
    seed = seed * 1103515245u + 12345u;
    if (present.size() > 3 && (seed >> 16) % 2 == 0) {
      const std::size_t which = (seed >> 18) % present.size();
      sim.change([&](auto& root) { root.takeChild(*root.find_node(text("n", present[which]))); });
      present.erase(present.begin() + std::ptrdiff_t(which));
    } else {
      sim.change([&](auto& root) { root.addChild(ball(text("n", i), i)); });
      present.push_back(i);
    }
    sim.animate(0.01);
  }
  // the same bodies in the same states, in a scene that is new
  RuntimeNode<Standard> fresh(sim.root());
  for (auto const& child : fresh.children()) {
    auto& s = *child->get<MechanicalObject<Vec3d>>();
    auto rest = s.restPosition;
    MechanicalObject<Vec3d> anew{.position = s.position, .velocity = s.velocity, .restPosition = rest};
    s = anew;
  }
  StandardSimulation other(std::move(fresh));
  other.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.01), other.animate(0.01);
  CHECK(bits_of(sim) == bits_of(other));
}

TEST_CASE("a scene that lost elements is saved, and read again goes on with the same bits") {
  auto sim = start(parse_scene<Standard>("carved.scn", R"(<Node name="root" dt="0.01" gravity="0 -1 0">
    <EulerImplicitSolver/> <SparseLDLSolver template="CompressedRowSparseMatrixMat3x3d"/>
    <RegularGridTopology name="grid" n="4 3 3" max="3 2 2"/>
    <Node name="body">
      <MeshTopology name="cells" position="@../grid.position" hexahedra="@../grid.hexahedra"/>
      <MechanicalObject template="Vec3d" position="@../grid.position"/>
      <DiagonalMass massDensity="2"/>
      <HexahedronFEMForceField youngModulus="200" poissonRatio="0.3"/>
      <ConstantForceField indices="3" forces="0 0 1"/>
      <FixedConstraint indices="0 4 8 12"/>
      <Node name="ends"> <MechanicalObject template="Vec3d"/> <SubsetMapping indices="35 3 0"/> </Node>
    </Node></Node>)"));
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  // cell 2 is at the end where the force is: its point 3 is in no other
  sim.removeElements("body", {.hexahedra = {2}});
  sim.animate(0.01);
  auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.01)));
  CHECK(bits_of(again) == bits_of(sim));
  CHECK(again.root().find_node("body")->get<ConstantForceField<Vec3d>>()->none);
  CHECK(again.root().find_node("body/ends")->get<MechanicalObject<Vec3d>>()->size() == 2);
  for (int i = 0; i < 5; ++i) sim.animate(0.01), again.animate(0.01);
  CHECK(bits_of(again) == bits_of(sim));
}

TEST_CASE("a mapping that takes the place of another may give its state other points") {
  auto sim = world();
  auto follow = [&](std::vector<int> indices) {
    sim.change([&](RuntimeNode<Standard>& root) {
      auto* ends = root.find_node("a/ends");
      if (ends)
        ends->remove("SubsetMapping");
      else
        ends = &root.find_node("a")->addChild("ends");
      if (!ends->get<MechanicalObject<Vec3d>>()) {
        ends->add(MechanicalObject<Vec3d>{});
        ends->add(ConstantForceField<Vec3d>{.indices = {0}, .force = {{1, 0, 0}}});
      }
      ends->add(SubsetMapping<Vec3d, Vec3d>{.indices = indices});
    });
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    auto const &x = state(sim, "a").position, &followed = state(sim, "a/ends").position;
    REQUIRE(followed.size() == indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) CHECK(followed[i] == x[std::size_t(indices[i])]);
  };
  follow({0, 1, 0});
  follow({1, 0, 1, 0, 1, 0, 1, 0});
  follow({1});
}

}  // namespace test_change
