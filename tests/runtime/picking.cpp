// SPDX-License-Identifier: BSL-1.0
// Picking and pulling in a runtime tree and in the typed scene: the same bits.

#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_picking {

using namespace sinew;

namespace {

TetrahedronTopology topology() { return {{{0, 1, 2, 3}}}; }
MechanicalObject<Vec3d> state() { return {.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.1};
constexpr CGLinearSolver<> solver{.iterations = 25, .tolerance = 1e-9};

auto runtime() {
  RuntimeNode<Standard> root;
  root.add(Gravity{{0, 0, -10}}), root.add(DefaultPipeline{}), root.add(BruteForceBroadPhase{});
  root.add(BVHNarrowPhase{}), root.add(near), root.add(DefaultContactManager{});
  auto& body = root.addChild("body");
  body.add(EulerImplicitSolver{}), body.add(solver), body.add(topology()), body.add(state());
  body.add(UniformMass<Vec3d>{.vertexMass = 2});
  body.add(TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3});
  body.add(FixedConstraint<Vec3d>{.indices = {0}});
  body.add(TriangleCollisionModel<Vec3d>{});
  return Simulation{std::move(root)};
}
auto typed() {
  return Simulation{
      node<"root">(Gravity{{0, 0, -10}},
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   near,
                   DefaultContactManager{},
                   node<"body">(EulerImplicitSolver{},
                                solver,
                                topology(),
                                state(),
                                UniformMass<Vec3d>{.vertexMass = 2},
                                TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                                FixedConstraint<Vec3d>{.indices = {0}},
                                TriangleCollisionModel<Vec3d>{}))};
}

}  // namespace

TEST_CASE("a place picked and pulled in a runtime tree and in a typed scene: the same bits") {
  auto sim = runtime();
  auto fixed = typed();
  sim.init(), fixed.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.01), fixed.animate(0.01);
  const Eigen::Vector3d eye(3, 3, 3), aim(-1, -1, -1);
  const auto a = sim.pick(eye, aim), b = fixed.pick(eye, aim);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->path == b->path);
  CHECK(a->point == b->point);
  CHECK(a->distance == b->distance);
  CHECK(a->place.vertices == b->place.vertices);
  CHECK(a->place.weights == b->place.weights);
  const int one = sim.attach(*a, {.stiffness = 500, .damping = 5}),
            two = fixed.attach(*b, {.stiffness = 500, .damping = 5});
  CHECK(one == two);
  auto& state = *sim.root().find_node("body")->get<MechanicalObject<Vec3d>>();
  auto both = [&] {
    sim.animate(0.01), fixed.animate(0.01);
    REQUIRE(state.position == fixed.at<"body">().state().position);
  };
  const auto before = state.position;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d target = a->point + 0.01 * i * Eigen::Vector3d(1, 1, 1);
    CHECK(sim.pull(one, target));
    CHECK(fixed.pull(two, target));
    both();
  }
  CHECK((state.position[3] - before[3]).norm() > 0.1);
  CHECK(sim.release(one));
  CHECK(fixed.release(two));
  for (int i = 0; i < 20; ++i) both();
}

}  // namespace test_picking
