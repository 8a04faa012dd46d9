// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"
#include "validation/closed_forms.hpp"

#include <sinew/solver/central_difference.hpp>
#include <sinew/solver/runge_kutta45.hpp>
#include <sinew/solver/variational_symplectic.hpp>

namespace test_convergence_explicit {

using namespace sinew;
using namespace closed_form;

namespace {

/// On the damped spring of oscillator_error; the velocity is set to that of half a step before the start.
double central_difference_error(int steps, double rM) {
  const double end = 1.3, h = end / steps, c = rM / 2, w = std::sqrt(4 - c * c);
  auto v = [&](double t) { return -0.5 * std::exp(-c * t) * 4 / w * std::sin(w * t); };
  auto sim = mass_on_spring(CentralDifferenceSolver{.rayleighMass = rM}, {1.5, 0}, {v(-h / 2), 0});
  for (int i = 0; i < steps; ++i) sim.animate(h);
  const double x = 1 + 0.5 * std::exp(-c * end) * (std::cos(w * end) + c / w * std::sin(w * end));
  auto const& s = sim.root().state();
  return std::hypot(s.position[1][0] - x, s.velocity[1][0] - v(end - h / 2));
}

const double inertia3[] = {1, 2, 3};

/// Angular momentum of a free body that tumbles about its middle axis, which stays as it is.
double tumbling_error(int steps, RungeKutta45Solver solver) {
  const Eigen::Matrix3d inertia = Eigen::Vector3d(inertia3[0], inertia3[1], inertia3[2]).asDiagonal();
  Vec<double, 6> v;
  v << 0, 0, 0, 0.3, 2, 0.1;
  RegistryScene sim{node<"root">(solver,
                                 MechanicalObject<Rigid3d>{.position = {{}}, .velocity = {v}},
                                 UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, inertia}})};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(2.0 / steps);
  auto const& s = sim.root().state();
  const Eigen::Matrix3d r = s.position[0].orientation.toRotationMatrix();
  return (r * inertia * r.transpose() * s.velocity[0].tail<3>() - inertia * v.tail<3>()).norm();
}

}  // namespace

TEST_CASE("central differences have order 2, damped or not") {
  CHECK(order([](int n) { return central_difference_error(n, 0); }, 200) == Approx(2).margin(0.05));
  CHECK(order([](int n) { return central_difference_error(n, 0.7); }, 200) == Approx(2).margin(0.05));
}

TEST_CASE("Dormand and Prince have order 5 without control") {
  const RungeKutta45Solver fixed{.tolerance = 0};
  CHECK(order([&](int n) { return oscillator_error(fixed, n); }, 16) == Approx(5).margin(0.15));
  CHECK(order([&](int n) { return orbit_error(fixed, n); }, 60) == Approx(5).margin(0.15));
  CHECK(order([&](int n) { return tumbling_error(n, fixed); }, 40) >= 4.8);
}

TEST_CASE("control keeps the error near its tolerance, with substeps that grow as its fifth root") {
  int substeps[2];
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    auto sim = mass_on_spring(
        RungeKutta45Solver{.tolerance = i == 0 ? 1e-6 : 1e-6 / 1024}, {2, 0}, {0, 2 * std::sqrt(2.0)});
    sim.animate(2);  // one step of the scene
    auto const& s = sim.root().state();
    const double w = std::sqrt(2.0);
    errors[i] = (s.position[1] - Eigen::Vector2d(2 * std::cos(2 * w), 2 * std::sin(2 * w))).norm();
    substeps[i] = sim.root().get<RungeKutta45Solver>().substeps;
    CHECK(sim.root().get<RungeKutta45Solver>().rough == 0);
  }
  CHECK(substeps[0] >= 4);
  CHECK(double(substeps[1]) / substeps[0] == Approx(4).margin(0.8));  // 1024^(1/5)
  CHECK(errors[0] < 20 * 1e-6);                                       // of some ten substeps
  CHECK(errors[1] < 80 * 1e-6 / 1024);
}

TEST_CASE("substeps are no shorter than allowed, and say so") {
  auto sim = mass_on_spring(RungeKutta45Solver{.tolerance = 1e-14, .maxSubsteps = 8}, {2, 0}, {0, 2});
  sim.animate(1);
  auto const& solver = sim.root().get<RungeKutta45Solver>();
  CHECK(solver.substeps == 8);
  CHECK(solver.rough == 8);
  // a scene in many small steps takes none but its own
  auto fine = mass_on_spring(RungeKutta45Solver{.tolerance = 1e-6}, {2, 0}, {0, 2});
  for (int i = 0; i < 20; ++i) {
    fine.animate(0.01);
    CHECK(fine.root().get<RungeKutta45Solver>().substeps == 1);
  }
  CHECK(fine.time() == Approx(0.2));
}

TEST_CASE("explicit integration of VariationalSymplecticSolver is symplectic Euler") {
  CHECK(oscillator_error(VariationalSymplecticSolver{.explicitIntegration = true}, 50) ==
        oscillator_error(EulerExplicitSolver{}, 50));
}

}  // namespace test_convergence_explicit
