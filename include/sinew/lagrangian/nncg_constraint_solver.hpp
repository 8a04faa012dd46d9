// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Nonsmooth nonlinear conjugate gradients over the compliance W (Silcowitz, Niebe, Erleben 2010): a sweep of
/// block Gauss-Seidel takes the place of the gradient.
struct NNCGConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "NNCGConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool useSVDForRegularization = false;
  double svdSingularValueNullSpaceCriteriaFactor = 0.01, svdSingularVectorNullSpaceCriteriaFactor = 0.001;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  bool computeConstraintForces = false;

  static constexpr auto fields() { return sweeping_fields<NNCGConstraintSolver>(); }

  static constexpr auto outputs() { return constraint_forces_output<NNCGConstraintSolver>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};
  NullSpaceRows dependent{};

  std::string unsolved() const { return unsolved_by_sweeps(*this); }
  void solve(ConstraintProblem& problem, std::string_view where) {
    sweep(*this, problem, where, [&](auto& p) {
      return sweeps.nonsmoothConjugateGradients(p, sweep_settings(*this), where);
    });
  }
};

}  // namespace sinew
