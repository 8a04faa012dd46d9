// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/sinew.hpp>

namespace test_convergence {

using namespace sinew;

namespace {

/// A constraint of this test's own: the centres of rigid bodies stay where they are, and the bodies turn.
struct HeldPivot {
  using Role = role::ProjectiveConstraint;
  using DataTypes = Rigid2d;
  static constexpr std::string_view className = "HeldPivot";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Rigid2d> const&) {}
  void projectResponse(Rigid2d::VecDeriv& dx) const {
    for (auto& d : dx) d.head<2>().setZero();
  }
};

/// log2 of the ratio of two errors, dt halved between them.
double order(double coarse, double fine) { return std::log2(coarse / fine); }

// One unit mass on a spring of stiffness 4 from the origin, length 1, along x: x = 1 + cos(2 t) / 2.
template <class... Solver>
double oscillator_error(int steps, Solver... solver) {
  const double end = 1.3;
  Simulation sim{node<"root">(
      solver...,
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1.5, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = 1},
      StiffSpringForceField<Vec3d>{.springs = {{.first = 0, .second = 1, .stiffness = 4, .length = 1}}},
      FixedConstraint<Vec3d>{.indices = {0}})};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(end / steps);
  auto const& state = sim.template at<"">().state();
  const double x = 1 + 0.5 * std::cos(2 * end), v = -std::sin(2 * end);
  return std::hypot(state.position[1][0] - x, state.velocity[1][0] - v);
}

// A pendulum of length 1 under gravity 10: a mass fixed to a body in the plane that turns about its pivot.
// The body is a Rigid2 whose pivot is held, and whose gravity acts on a mapped point mass, so only its angle
// moves:
//   phi'' = -(g m / (m + I)) sin phi
// The closed form is phi(t) = 2 asin(k sn(K(k) - w t, k)), k = sin(phi0/2); its quarter period is K(k) / w.
double quarter_period(double w, double phi0) {
  // K(k) = pi / (2 agm(1, cos(phi0/2)))                                             (Gauss)
  double a = 1, g = std::cos(phi0 / 2);
  for (int i = 0; i < 20; ++i) {
    const double mean = (a + g) / 2;
    g = std::sqrt(a * g);
    a = mean;
  }
  return 3.14159265358979323846 / (2 * a) / w;
}

// After a quarter period the pendulum hangs straight down: the angle is the error.
template <class... Solver>
double pendulum_error(int steps, Solver... solver) {
  const double phi0 = 1, g = 10, inertia = 0.25;
  Simulation sim{node<"root">(
      Gravity{{0, -g, 0}},
      solver...,
      MechanicalObject<Rigid2d>{.position = {{{0, 0}, phi0}}},
      UniformMass<Rigid2d>{.vertexMass = RigidMass<double, 2>{1, (Mat<double, 1>() << inertia).finished()}},
      HeldPivot{},
      node<"bob">(MechanicalObject<Vec2d>{.position = {{0, -1}}},
                  RigidMapping<Rigid2d, Vec2d>{},
                  ConstantForceField<Vec2d>{.indices = {0}, .forces = {{0, -g}}}))};
  sim.init();
  const double end = quarter_period(std::sqrt(g / inertia), phi0);
  for (int i = 0; i < steps; ++i) sim.animate(end / steps);
  return std::abs(sim.template at<"">().state().position[0].orientation);
}

}  // namespace

TEST_CASE("free fall follows the recurrence of symplectic Euler exactly") {
  Simulation sim{node<"root">(Gravity{{0, -10, 0}},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{1, 0, 0}}},
                              UniformMass<Vec3d>{.vertexMass = 2})};
  sim.init();
  const double h = 0.125;  // a power of two, so that the sums below are exact
  for (int n = 1; n <= 64; ++n) {
    sim.animate(h);
    auto const& s = sim.at<"">().state();
    CHECK(s.velocity[0][1] == -10 * h * n);
    CHECK(s.position[0][1] == -10 * h * h * n * (n + 1) / 2);
    CHECK(s.position[0][0] == h * n);
  }
  CHECK(sim.time() == 8);
}

TEST_CASE("each solver has its order on a spring with a closed form") {
  auto measured = [](auto error) { return order(error(400), error(800)); };
  CHECK(measured([](int n) { return oscillator_error(n, EulerExplicitSolver{.symplectic = true}); }) ==
        Approx(1).margin(0.05));
  CHECK(measured([](int n) { return oscillator_error(n, EulerExplicitSolver{.symplectic = false}); }) ==
        Approx(1).margin(0.05));
  CHECK(measured([](int n) { return oscillator_error(n, RungeKutta2Solver{}); }) == Approx(2).margin(0.05));
  CHECK(order(oscillator_error(40, RungeKutta4Solver{}), oscillator_error(80, RungeKutta4Solver{})) ==
        Approx(4).margin(0.1));
  CHECK(measured([](int n) {
          return oscillator_error(
              n, EulerImplicitSolver{}, CGLinearSolver<>{.iterations = 100, .tolerance = 1e-12});
        }) == Approx(1).margin(0.05));
}

TEST_CASE("each solver has its order on a pendulum with a closed form") {
  auto error = [](int n, auto... solver) { return pendulum_error(n, solver...); };
  CHECK(order(error(400, EulerExplicitSolver{}), error(800, EulerExplicitSolver{})) == Approx(1).margin(0.1));
  CHECK(order(error(400, EulerExplicitSolver{.symplectic = false}),
              error(800, EulerExplicitSolver{.symplectic = false})) == Approx(1).margin(0.1));
  CHECK(order(error(100, RungeKutta2Solver{}), error(200, RungeKutta2Solver{})) == Approx(2).margin(0.1));
  CHECK(order(error(20, RungeKutta4Solver{}), error(40, RungeKutta4Solver{})) == Approx(4).margin(0.2));
  const CGLinearSolver<> cg{.iterations = 100, .tolerance = 1e-12};
  CHECK(order(error(400, EulerImplicitSolver{}, cg), error(800, EulerImplicitSolver{}, cg)) ==
        Approx(1).margin(0.1));
}

}  // namespace test_convergence
