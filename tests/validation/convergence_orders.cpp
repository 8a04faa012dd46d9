// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "validation/closed_forms.hpp"
#include "validation/record.hpp"

#include <sinew/registry.hpp>

namespace test_convergence_orders {

using namespace sinew;
using namespace closed_form;

namespace {

/// Error at the end of a circular orbit about the end of a spring, of radius 2, with w = sqrt(2): not linear.
template <class Solver>
double error_of(Solver const& solver, int steps) {
  return orbit_error(solver, steps);
}
// its velocities are those half a step before: given so at the start, and compared so at the end
double error_of(CentralDifferenceSolver const& solver, int steps) {
  const double end = 2, w = std::sqrt(2.0), h = end / steps;
  auto velocity = [&](double t) {
    return Eigen::Vector2d(-2 * w * std::sin(w * t), 2 * w * std::cos(w * t));
  };
  auto sim = mass_on_spring(solver, {2, 0}, velocity(-h / 2));
  for (int i = 0; i < steps; ++i) sim.animate(h);
  auto const& s = sim.root().state();
  const Eigen::Vector2d x(2 * std::cos(w * end), 2 * std::sin(w * end));
  return std::hypot((s.position[1] - x).norm(), (s.velocity[1] - velocity(end - h / 2)).norm());
}

}  // namespace

TEST_CASE("every solver of the registry has the order that it claims", "[page]") {
  Record curve("orders", {"solver", "h", "error"}), table("orders_table", {"solver", "claimed", "measured"});
  auto measure = [&](std::string name, auto solver, int claimed) {
    INFO(name);
    // steps at which the error is that of the leading term, and still far from rounding
    const int steps = claimed >= 4 ? 64 : 256;
    const double measured = order([&](int n) { return error_of(solver, n); }, steps);
    // the next term of the error is smaller by w h and a constant: 0.1 leaves it room
    CHECK(measured == Approx(claimed).margin(0.1));
    table.row(name, claimed, measured);
    for (int n = 16; Record::wanted() && n <= 2048; n *= 2) curve.row(name, 2.0 / n, error_of(solver, n));
  };
  for_each_registered<Standard>([&]<class C>() {
    if constexpr (std::is_same_v<typename C::Role, role::OdeSolver>) {
      if constexpr (C::convergenceOrder > 0) {
        C solver{};
        if constexpr (requires { solver.tolerance; }) solver.tolerance = 0;  // no control of the step
        measure(std::string(C::className), solver, C::convergenceOrder);
      }
    }
  });
  measure("EulerExplicitSolver symplectic=0", EulerExplicitSolver{.symplectic = false}, 1);
  measure("EulerImplicitSolver trapezoidalScheme", EulerImplicitSolver{.trapezoidalScheme = true}, 2);
  measure("BDFOdeSolver order=2", BDFOdeSolver{.order = 2}, 2);
  measure("BDFOdeSolver order=3", BDFOdeSolver{.order = 3}, 3);
}

}  // namespace test_convergence_orders
