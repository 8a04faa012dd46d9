// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "validation/closed_forms.hpp"
#include "validation/record.hpp"

#include <sinew/solver/central_difference.hpp>
#include <sinew/solver/newmark_implicit.hpp>
#include <sinew/solver/runge_kutta45.hpp>
#include <sinew/solver/variational_symplectic.hpp>

namespace test_energy_drift {

using namespace sinew;
using namespace closed_form;

TEST_CASE("symplectic solvers keep energy and momentum over 100,000 steps of an orbit") {
  // h w = 0.05: an error of the energy of order (h w)^p, which swings and does not grow: the first 1,000
  // steps have seen all of it
  const double h = 0.05 / std::sqrt(2.0);
  auto grows = [&](auto solver) {
    return orbit_drift(solver, 100000, h).energy / orbit_drift(solver, 1000, h).energy;
  };
  CHECK(grows(EulerExplicitSolver{}) < 1.05);
  CHECK(grows(CentralDifferenceSolver{}) < 1.05);
  const VariationalSymplecticSolver midpoint{.newtonError = 1e-13, .steps = 20};
  CHECK(grows(midpoint) < 1.05);
  const Drift drift = orbit_drift(midpoint, 100000, h);
  CHECK(drift.energy < 1e-3);
  CHECK(drift.momentum < 1e-9);  // quadratic, so kept exactly: rounding of 100,000 steps
  CHECK(orbit_drift(EulerExplicitSolver{}, 1000, h).momentum < 1e-12);
  // what loses energy loses it all: the test can fail
  CHECK(orbit_drift(EulerImplicitSolver{}, 1000, h).energy > 0.1);
}

TEST_CASE("the trapezoidal rule and Newmark keep the energy of a linear system") {
  // along the spring, E = k (x - 1)^2 / 2 + m v^2 / 2 is kept to rounding: sqrt(10^5) steps of 1e-16 or less
  // than 10^5 of them
  auto drift = [](auto solver) {
    auto sim = mass_on_spring(solver, {1.5, 0}, {0, 0});
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
      sim.animate(0.1);
      worst = std::max(worst, std::abs(sim.kineticEnergy() + sim.potentialEnergy() - 1));
    }
    return worst;
  };
  CHECK(drift(EulerImplicitSolver{.trapezoidalScheme = true}) < 1e-10);
  CHECK(drift(NewmarkImplicitSolver{}) < 1e-10);
  CHECK(drift(VariationalSymplecticSolver{}) < 1e-10);
}

TEST_CASE("the energy of an orbit over 100,000 steps, for the page", "[page]") {
  // the orbit above; the largest error so far, at steps that grow by turns 2, 2.5 and 2 times
  Record curve("energy_drift", {"solver", "step", "error"});
  const int last = Record::wanted() ? 100000 : 1000;
  auto follow = [&](std::string name, auto solver) {
    auto sim = mass_on_spring(solver, {2, 0}, {0, 2});
    auto energy = [&] { return sim.kineticEnergy() + sim.potentialEnergy(); };
    const double start = energy();
    double worst = 0;
    for (int i = 1, next = 10; i <= last; ++i) {
      sim.animate(0.05 / std::sqrt(2.0));
      worst = std::max(worst, std::abs(energy() / start - 1));
      if (i < next) continue;
      curve.row(name, i, worst);
      next = next * (text(next)[0] == '2' ? 5 : 4) / 2;
    }
    return worst;
  };
  const double symplectic = follow("EulerExplicitSolver", EulerExplicitSolver{});
  CHECK(symplectic < 0.1);
  follow("CentralDifferenceSolver", CentralDifferenceSolver{});
  follow("VariationalSymplecticSolver", VariationalSymplecticSolver{.newtonError = 1e-13, .steps = 20});
  follow("NewmarkImplicitSolver", NewmarkImplicitSolver{});
  follow("RungeKutta4Solver", RungeKutta4Solver{});
  follow("RungeKutta2Solver", RungeKutta2Solver{});
  CHECK(follow("EulerImplicitSolver", EulerImplicitSolver{}) > symplectic);
}

}  // namespace test_energy_drift
