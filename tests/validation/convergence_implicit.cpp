// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"
#include "validation/closed_forms.hpp"

#include <sinew/solver/bdf2.hpp>
#include <sinew/solver/newmark_implicit.hpp>
#include <sinew/solver/variational_symplectic.hpp>

namespace test_convergence_implicit {

using namespace sinew;
using namespace closed_form;

TEST_CASE("implicit solvers have their order on a damped spring") {
  const double rM = 0.3, rK = 0.1;
  auto measured = [&](auto solver) {
    solver.rayleighMass = rM;
    solver.rayleighStiffness = rK;
    return order([&](int n) { return oscillator_error(solver, n, rM, rK); }, 200);
  };
  CHECK(measured(EulerImplicitSolver{}) == Approx(1).margin(0.05));
  CHECK(measured(EulerImplicitSolver{.trapezoidalScheme = true}) == Approx(2).margin(0.05));
  CHECK(measured(NewmarkImplicitSolver{}) == Approx(2).margin(0.05));
  CHECK(measured(NewmarkImplicitSolver{.gamma = 0.5, .beta = 1.0 / 6}) == Approx(2).margin(0.05));
  CHECK(measured(NewmarkImplicitSolver{.gamma = 0.6, .beta = 0.3025}) == Approx(1).margin(0.05));
  CHECK(measured(VariationalSymplecticSolver{}) == Approx(2).margin(0.05));
  CHECK(measured(BDFOdeSolver{.order = 2}) == Approx(2).margin(0.05));
  CHECK(measured(BDFOdeSolver{.order = 1}) == Approx(1).margin(0.05));
  CHECK(measured(BDFOdeSolver{.order = 3}) == Approx(3).margin(0.1));
}

TEST_CASE("implicit solvers have their order on a circular orbit") {
  auto measured = [](auto solver) { return order([&](int n) { return orbit_error(solver, n); }, 200); };
  CHECK(measured(EulerImplicitSolver{}) == Approx(1).margin(0.1));
  CHECK(measured(EulerImplicitSolver{.trapezoidalScheme = true}) == Approx(2).margin(0.05));
  CHECK(measured(NewmarkImplicitSolver{}) == Approx(2).margin(0.05));
  CHECK(measured(VariationalSymplecticSolver{.newtonError = 1e-12, .steps = 20}) == Approx(2).margin(0.05));
  // one iteration of Newton's method has the order already
  CHECK(measured(VariationalSymplecticSolver{.steps = 1}) == Approx(2).margin(0.05));
  CHECK(measured(BDFOdeSolver{.order = 2}) == Approx(2).margin(0.1));
  CHECK(measured(BDFOdeSolver{.order = 2, .maxNbIterationsNewton = 20}) == Approx(2).margin(0.1));
  CHECK(measured(BDFOdeSolver{.order = 3}) == Approx(3).margin(0.1));
  CHECK(measured(EulerImplicitSolver{.maxNbIterationsNewton = 20,
                                     .relativeInitialStoppingThreshold = 1e-10}) == Approx(1).margin(0.1));
  CHECK(measured(EulerImplicitSolver{.trapezoidalScheme = true,
                                     .maxNbIterationsNewton = 20,
                                     .relativeInitialStoppingThreshold = 1e-10}) == Approx(2).margin(0.05));
}

TEST_CASE("steps of different lengths do not cost BDF its order") {
  CHECK(order([](int n) { return oscillator_error(BDFOdeSolver{.order = 2}, n, 0, 0, 1.5); }, 200) ==
        Approx(2).margin(0.05));
  CHECK(order([](int n) { return oscillator_error(BDFOdeSolver{.order = 3}, n, 0, 0, 1.5); }, 200) ==
        Approx(3).margin(0.1));
  // and what is remembered counts: of order 1, the error is many times larger
  CHECK(oscillator_error(BDFOdeSolver{.order = 1}, 200) >
        20 * oscillator_error(BDFOdeSolver{.order = 2}, 200));
}

TEST_CASE("a reset forgets the steps before") {
  auto sim = mass_on_spring(BDFOdeSolver{.order = 2}, {1.5, 0}, {0, 0.5});
  auto run = [&] {
    for (int i = 0; i < 5; ++i) sim.animate(0.1);
    return sim.root().state().position[1];
  };
  const Eigen::Vector2d first = run();
  sim.reset();
  CHECK(run() == first);
}

TEST_CASE("on a linear spring one iteration of Newton's method is all") {
  auto sim = mass_on_spring(VariationalSymplecticSolver{.newtonError = 1e-12}, {1.5, 0}, {0, 0});
  sim.animate(0.1);
  CHECK(sim.root().get<VariationalSymplecticSolver>().iterations ==
        2);  // the second finds nothing to correct
  auto bdf = mass_on_spring(BDFOdeSolver{.order = 2, .maxNbIterationsNewton = 9}, {1.5, 0}, {0, 0});
  bdf.animate(0.1);
  CHECK(bdf.root().get<BDFOdeSolver>().newton.corrections.size() == 1);
}

TEST_CASE("bodies without inertia flow to the root of their force") {
  // M v = f: x = 1 + e^-4t / 2, for stiffness 8 and mass 2
  auto error = [](bool trapezoidal, int steps) {
    auto sim = mass_on_spring(
        EulerImplicitSolver{.firstOrder = true, .trapezoidalScheme = trapezoidal}, {1.5, 0}, {0, 0});
    for (int i = 0; i < steps; ++i) sim.animate(0.5 / steps);
    return std::abs(sim.root().state().position[1][0] - (1 + 0.5 * std::exp(-2)));
  };
  CHECK(order([&](int n) { return error(false, n); }, 200) == Approx(1).margin(0.05));
  CHECK(order([&](int n) { return error(true, n); }, 200) == Approx(2).margin(0.05));
}

TEST_CASE("vdamping makes velocities decay at its rate") {
  auto decayed = [](auto solver) {
    solver.vdamping = 0.5;
    RegistryScene sim{node<"root">(solver,
                                   SparseLDLSolver<>{},
                                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{1, 0, 0}}},
                                   UniformMass<Vec3d>{.vertexMass = 2})};
    sim.init();
    for (int i = 0; i < 8; ++i) sim.animate(0.25);
    return sim.root().state().velocity[0][0];
  };
  CHECK(decayed(EulerImplicitSolver{}) == Approx(std::exp(-1)).epsilon(1e-14));
  CHECK(decayed(NewmarkImplicitSolver{}) == Approx(std::exp(-1)).epsilon(1e-14));
}

}  // namespace test_convergence_implicit
