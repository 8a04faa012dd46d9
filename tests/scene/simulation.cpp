// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/sinew.hpp>

namespace test_simulation {

using namespace sinew;

namespace {

auto falling(double g) {
  return node<"ball">(
      Gravity{{0, -g, 0}}, MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}, UniformMass<Vec3d>{});
}

}  // namespace

TEST_CASE("paths find nodes, components are found by class") {
  Simulation sim{node<"root">(
      EulerExplicitSolver{}, node<"a">(node<"b">(falling(1)), Gravity{}), node<"c">(falling(2)))};
  sim.init();
  CHECK(&sim.at<"">() == &sim.root());
  CHECK(sim.at<"a/b/ball">().state().size() == 1);
  CHECK(&sim.at<"a/b/ball">().state() != &sim.at<"c/ball">().state());
  CHECK(sim.at<"c/ball">().get<Gravity>().gravity.y() == -2);
  static_assert(std::decay_t<decltype(sim.at<"a">())>::childCount == 1);
}

TEST_CASE("the nearest gravity above counts, and each body feels its own") {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      Gravity{{0, -1, 0}},
      node<"own">(falling(5)),
      node<"inherited">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}, UniformMass<Vec3d>{}))};
  sim.init();
  sim.animate(1);
  CHECK(sim.at<"own/ball">().state().velocity[0].y() == -5);
  CHECK(sim.at<"inherited">().state().velocity[0].y() == -1);
}

TEST_CASE("components below a state act on it") {
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                   node<"physics">(UniformMass<Vec3d>{.vertexMass = 2},
                                   ConstantForceField<Vec3d>{.indices = {0}, .forces = {{4, 0, 0}}}))};
  sim.init();
  sim.animate(0.5);
  CHECK(sim.root().state().velocity[0].x() == 1);
}

TEST_CASE("each ODE solver integrates its own subtree") {
  Simulation sim{node<"root">(Gravity{{0, -1, 0}},
                              node<"explicit">(EulerExplicitSolver{.symplectic = false},
                                               MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                               UniformMass<Vec3d>{}),
                              node<"implicit">(EulerImplicitSolver{.rayleighMass = 1},
                                               CGLinearSolver<>{},
                                               MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                               UniformMass<Vec3d>{}),
                              node<"still">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}))};
  sim.init();
  sim.animate(0.5);
  CHECK(sim.at<"explicit">().state().position[0].y() == 0);
  CHECK(sim.at<"explicit">().state().velocity[0].y() == -0.5);
  CHECK(sim.at<"implicit">().state().velocity[0].y() == Approx(-0.5 / 1.5));  // v = h g / (1 + h rM)
  CHECK(sim.at<"still">().state().velocity[0].y() == 0);
}

TEST_CASE("callbacks are called at the end of each step, with the step and their node") {
  int calls = 0;
  double seen = 0, height = 1;
  Simulation sim{node<"root">(
      Gravity{{0, -1, 0}},
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
      UniformMass<Vec3d>{},
      StepCallback{[&](StepInfo const& info) { calls += int(info.step), seen = info.time; }},
      StepCallback{[&](StepInfo const&, auto& here) { height = here.state().position[0].y(); }})};
  sim.init();
  sim.animate(0.5);
  CHECK(height == -0.25);
  sim.animate(0.5);
  CHECK(calls == 3);
  CHECK(seen == 1);
  CHECK(sim.step() == 2);
}

TEST_CASE("reset returns to the initial state, and init starts anew") {
  Simulation sim{node<"root">(Gravity{{0, -1, 0}},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{.position = {{0, 3, 0}}, .velocity = {{1, 0, 0}}},
                              UniformMass<Vec3d>{},
                              node<"twin">(MechanicalObject<Vec3f>{}, IdentityMapping<Vec3d, Vec3f>{}))};
  sim.init();
  CHECK(sim.at<"twin">().state().position[0].y() == 3);
  sim.animate(0.5);
  CHECK(sim.at<"twin">().state().position[0].x() == 0.5);
  CHECK(sim.at<"twin">().state().velocity[0].y() == -0.5);
  sim.reset();
  CHECK(sim.time() == 0);
  CHECK(sim.root().state().position[0] == Eigen::Vector3d(0, 3, 0));
  CHECK(sim.root().state().velocity[0] == Eigen::Vector3d(1, 0, 0));
  CHECK(sim.at<"twin">().state().position[0].x() == 0);
}

TEST_CASE("copies of a simulation are independent") {
  Simulation sim{node<"root">(EulerExplicitSolver{}, falling(1))};
  sim.init();
  auto copy = sim;
  sim.animate(1);
  CHECK(copy.at<"ball">().state().position[0].y() == 0);
  copy.animate(1);
  CHECK(copy.at<"ball">().state().position[0] == sim.at<"ball">().state().position[0]);
}

TEST_CASE("mappings of mappings carry motion down and forces up") {
  // a point on a rigid, seen twice: force on the grandchild turns the body
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      MechanicalObject<Rigid3d>{.position = {{}}},
      UniformMass<Rigid3d>{},
      node<"point">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}, {0, 2, 0}}},
                    RigidMapping<Rigid3d, Vec3d>{},
                    node<"chosen">(MechanicalObject<Vec3f>{},
                                   SubsetMapping<Vec3d, Vec3f>{.indices = {1}},
                                   ConstantForceField<Vec3f>{.indices = {0}, .forces = {{3, 0, 0}}})))};
  sim.init();
  CHECK(sim.at<"point/chosen">().state().position[0] == Eigen::Vector3f(0, 2, 0));
  sim.animate(0.001);
  auto const& v = sim.root().state().velocity[0];
  CHECK(v[0] == Approx(0.003));
  CHECK(v[5] == Approx(-0.006));  // r x f = (0, 2, 0) x (3, 0, 0) = (0, 0, -6)
}

TEST_CASE("energies are those of the components") {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {3, 0, 0}}, .velocity = {{0, 0, 0}, {0, 2, 0}}},
      UniformMass<Vec3d>{.vertexMass = 5},
      StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1, .stiffness = 10, .length = 2}}})};
  sim.init();
  CHECK(sim.kineticEnergy() == Approx(10));
  CHECK(sim.potentialEnergy() == Approx(5));
}

}  // namespace test_simulation
