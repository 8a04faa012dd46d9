// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/solver/newton.hpp>

namespace sinew {

/// Equilibrium, f(x) = 0 with forces at rest, by Newton's method: K dx = -f, x += s dx. What each iteration
/// did can be read from `newton`; a search that does not converge leaves the positions of its last iteration.
struct StaticSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "StaticSolver";
  static constexpr std::string_view aliases = "StaticOdeSolver StaticEquilibriumIntegrationScheme";
  static constexpr bool implicit = true;
  static constexpr int convergenceOrder = 0;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  int maxNbIterationsNewton = 1;
  double relativeSuccessiveStoppingThreshold = 0, relativeInitialStoppingThreshold = 1e-5,
         absoluteResidualStoppingThreshold = 1e-5, relativeEstimateDifferenceThreshold = 1e-5,
         absoluteEstimateDifferenceThreshold = 1e-5;
  bool shouldDivergeWhenResidualIsGrowing = false;
  int maxNbIterationsLineSearch = 0;
  double lineSearchCoefficient = 0.5;

  static constexpr auto fields() { return newton_fields<StaticSolver>("N", "m"); }

  NewtonReport newton{};

  ConstraintFactors constraintFactors(double) const { return {{.k = -1}, 1, 1, 0}; }

  template <class Operations>
  void init(Operations&) {
    newton.init(maxNbIterationsNewton);
  }

  template <class Operations>
  void solve(Operations& operations, double) {
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force),
        dx(operations, vec_id::dx);
    MultiVecDeriv increment(operations);
    auto evaluate = [&] {
      operations.propagate(pos.id, vel.id);
      operations.computeForce(force.id, pos.id, vel.id);
      operations.acted.clear();
      operations.acted.add(force.id);
      operations.projectResponse(force.id);
    };
    vel.clear();
    operations.acted.balanceWithoutInertia();
    sinew::newton(*this,
                  operations,
                  {.factors = {.k = -1}, .dx = dx, .b = force, .increment = increment, .equilibrium = true},
                  NewtonCallbacks{evaluate, [&](double s) { pos.peq(dx, s); }});
  }

  /// Solves the system where the search was at its end at its start, and has not: multipliers ask it for what
  /// they move.
  template <class Operations>
  void prepareCorrection(Operations& operations) {
    if (newton.status != NewtonStatus::alreadyInEquilibrium) return;
    MultiVecDeriv force(operations, vec_id::force), dx(operations, vec_id::dx);
    force.clear();
    dx.clear();
    operations.solveSystem({.k = -1}, dx, force);
  }
};

}  // namespace sinew
