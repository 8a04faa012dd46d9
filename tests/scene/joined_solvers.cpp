// SPDX-License-Identifier: BSL-1.0
// Bodies under solvers of their own, joined by springs: the springs' forces are those at the start of the
// step.
#include "catch.hpp"

#include <sinew/sinew.hpp>

#include <cmath>

namespace test_joined_solvers {

using namespace sinew;

namespace {

constexpr double stiffness = 40, mass = 0.5;

template <class First, class Second>
auto pair_of_masses(First first, Second second, double gap) {
  return Simulation{node<"root">(
      Gravity{{0, 0, 0}},
      StiffSpringForceField<Vec3d, Between<"left", "right">>{
          .springs = {{.first = 0, .second = 0, .stiffness = stiffness, .damping = 0, .length = 1}}},
      node<"left">(first,
                   CGLinearSolver<>{.iterations = 10, .tolerance = 1e-14},
                   MechanicalObject<Vec3d>{{{0, 0, 0}}},
                   UniformMass<Vec3d>{.vertexMass = mass}),
      node<"right">(second,
                    CGLinearSolver<>{.iterations = 10, .tolerance = 1e-14},
                    MechanicalObject<Vec3d>{{{gap, 0, 0}}},
                    UniformMass<Vec3d>{.vertexMass = mass}))};
}

}  // namespace

TEST_CASE("two symplectic solvers see what one above both would") {
  // symplectic Euler takes the force at the start of the step anyway
  auto apart = pair_of_masses(EulerExplicitSolver{}, EulerExplicitSolver{}, 1.2);
  Simulation together{node<"root">(
      Gravity{{0, 0, 0}},
      EulerExplicitSolver{},
      StiffSpringForceField<Vec3d, Between<"left", "right">>{
          .springs = {{.first = 0, .second = 0, .stiffness = stiffness, .damping = 0, .length = 1}}},
      node<"left">(MechanicalObject<Vec3d>{{{0, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = mass}),
      node<"right">(MechanicalObject<Vec3d>{{{1.2, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = mass}))};
  apart.init();
  together.init();
  for (int i = 0; i < 190; ++i) {
    apart.animate(0.01);
    together.animate(0.01);
    REQUIRE(apart.at<"right">().state().position[0] == together.at<"right">().state().position[0]);
    REQUIRE(apart.at<"left">().state().velocity[0] == together.at<"left">().state().velocity[0]);
  }
  // omega = sqrt(2 k / m): it swings
  CHECK(apart.at<"right">().state().position[0].x() != Approx(1.2).margin(0.01));
}

TEST_CASE("an explicit body beside an implicit one: momentum is kept, and the motion converges") {
  const double omega = std::sqrt(2 * stiffness / mass), end = 0.5;
  auto error = [&](double dt) {
    auto sim = pair_of_masses(EulerExplicitSolver{}, EulerImplicitSolver{}, 1.2);
    sim.init();
    while (sim.time() < end - dt / 2) {
      sim.animate(dt);
      const Eigen::Vector3d momentum =
          sim.at<"left">().state().velocity[0] + sim.at<"right">().state().velocity[0];
      REQUIRE(momentum.norm() < 1e-12);
    }
    const double gap = sim.at<"right">().state().position[0].x() - sim.at<"left">().state().position[0].x();
    return std::abs(gap - (1 + 0.2 * std::cos(omega * end)));
  };
  // the coupling is explicit: of first order
  const double coarse = error(0.001), fine = error(0.0005);
  CHECK(coarse < 0.01);
  CHECK(coarse / fine == Approx(2).epsilon(0.1));
}

TEST_CASE("a spring to a body that is carried along pulls its carrier") {
  Simulation sim{node<"root">(
      Gravity{{0, 0, 0}},
      StiffSpringForceField<Vec3d, Between<"free", "body/tip">>{
          .springs = {{.first = 0, .second = 0, .stiffness = stiffness, .damping = 0, .length = 1}}},
      node<"free">(EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{{{0, 0, 0}}},
                   UniformMass<Vec3d>{.vertexMass = mass}),
      node<"body">(EulerExplicitSolver{},
                   MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{.center = {1.4, 0, 0}}}},
                   UniformMass<Rigid3d>{},
                   node<"tip">(MechanicalObject<Vec3d>{{{0, 0.1, 0}}}, RigidMapping<Rigid3d, Vec3d>{})))};
  sim.init();
  sim.animate(1e-3);
  const auto v = sim.at<"body">().state().velocity[0];
  CHECK(v[0] < 0);
  CHECK(v[5] > 0);  // f = -x at r = 0.1 y: the torque r x f is along z
}

}  // namespace test_joined_solvers
