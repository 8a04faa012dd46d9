// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>

namespace test_rigid {

using namespace sinew;

namespace {

const Eigen::Matrix3d inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();

template <class Sim>
Eigen::Vector3d angular_momentum(Sim& sim) {
  auto const& s = sim.template at<"">().state();
  const Eigen::Matrix3d r = s.position[0].orientation.toRotationMatrix();
  return r * inertia * r.transpose() * s.velocity[0].template tail<3>();
}

template <class... Solvers>
auto spinning(Solvers... solvers) {
  Vec<double, 6> v;
  v << 0, 0, 0, 0.3, 2, 0.1;  // about the middle axis, where free rotation tumbles
  RegistryScene sim{node<"root">(solvers...,
                                 MechanicalObject<Rigid3d>{.position = {{}}, .velocity = {v}},
                                 UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, inertia}})};
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("a rigid body that spins free keeps its angular momentum and stays unit") {
  auto sim = spinning(RungeKutta4Solver{});
  const Eigen::Vector3d start = angular_momentum(sim);
  const double energy = sim.kineticEnergy();
  for (int i = 0; i < 2000; ++i) {
    sim.animate(0.005);
    REQUIRE(std::abs(sim.at<"">().state().position[0].orientation.norm() - 1) < 1e-14);
  }
  CHECK(sim.time() == Approx(10));
  CHECK((angular_momentum(sim) - start).norm() < 1e-8 * start.norm());
  CHECK(sim.kineticEnergy() == Approx(energy).epsilon(1e-8));
  // and it did tumble: the middle axis has turned over
  CHECK(sim.at<"">().state().velocity[0].norm() > 1);
}

TEST_CASE("rotations have the order of their solver") {
  auto momentum_error = [](auto solver, int steps) {
    auto sim = spinning(solver);
    const Eigen::Vector3d start = angular_momentum(sim);
    for (int i = 0; i < steps; ++i) sim.animate(2.0 / steps);
    return (angular_momentum(sim) - start).norm();
  };
  CHECK(std::log2(momentum_error(RungeKutta4Solver{}, 50) / momentum_error(RungeKutta4Solver{}, 100)) >= 3.8);
  CHECK(std::log2(momentum_error(RungeKutta2Solver{}, 200) / momentum_error(RungeKutta2Solver{}, 400)) >=
        1.9);
}

TEMPLATE_TEST_CASE("a body that tumbles gains no energy from steps that turn it far", "", EulerExplicitSolver,
                   EulerImplicitSolver) {
  auto make = [](double dt) {
    // |w| = 2, so 0.2, 1 or 5 rad a step
    if constexpr (TestType::implicit)
      return std::pair{spinning(TestType{}, CGLinearSolver<>{.iterations = 20, .tolerance = 1e-14}), dt};
    else
      return std::pair{spinning(TestType{}), dt};
  };
  for (const double h : {0.1, 0.5, 2.5}) {
    auto [sim, dt] = make(h);
    double energy = sim.kineticEnergy(), maximum = 0;
    const double start = energy;
    bool turnedOver = false;
    for (int i = 0; i < 10000; ++i) {
      sim.animate(dt);
      maximum = std::max(maximum, sim.kineticEnergy() / energy - 1);
      energy = sim.kineticEnergy();
      auto const& s = sim.template at<"">().state();
      turnedOver |=
          (s.position[0].orientation.conjugate() * Eigen::Vector3d(s.velocity[0].template tail<3>()))[1] < -1;
    }
    CHECK(maximum < 1e-12);
    CHECK(energy > 0);
    CHECK(energy < start);
    CHECK((turnedOver || h > 0.1));
  }
  // and the angular momentum has an error of first order
  auto momentum_error = [&](int steps) {
    auto [sim, dt] = make(1.0 / steps);
    const Eigen::Vector3d start = angular_momentum(sim);
    for (int i = 0; i < steps; ++i) sim.animate(dt);
    return (angular_momentum(sim) - start).norm();
  };
  CHECK(momentum_error(400) > 1e-6);
  CHECK(std::log2(momentum_error(200) / momentum_error(400)) == Approx(1).margin(0.1));
}

TEST_CASE("a spinning symmetric top precesses as Euler says") {
  // free symmetric body, I = (1, 1, 2): w_3 is constant, and (w_1, w_2) turns in body axes at (I3 - I1) / I1
  // w_3
  Vec<double, 6> v;
  v << 0, 0, 0, 1, 0, 3;
  RegistryScene sim{
      node<"root">(RungeKutta4Solver{},
                   MechanicalObject<Rigid3d>{.position = {{}}, .velocity = {v}},
                   UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{
                                            1, Eigen::Vector3d(1, 1, 2).asDiagonal().toDenseMatrix()}})};
  sim.init();
  const double end = 1.5;
  for (int i = 0; i < 600; ++i) sim.animate(end / 600);
  auto const& s = sim.at<"">().state();
  const Eigen::Vector3d w = s.position[0].orientation.conjugate() * Eigen::Vector3d(s.velocity[0].tail<3>());
  CHECK(w[0] == Approx(std::cos(3 * end)).margin(1e-8));
  CHECK(w[1] == Approx(std::sin(3 * end)).margin(1e-8));
  CHECK(w[2] == Approx(3).margin(1e-8));
}

}  // namespace test_rigid
