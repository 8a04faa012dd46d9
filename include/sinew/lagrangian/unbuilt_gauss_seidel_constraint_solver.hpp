// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Block Gauss-Seidel (Duriez et al. 2006) over a compliance W that is never formed: what a block changes
/// moves the bodies, W f = J (A^-1 J' f), and each block looks at these. Room and time of a sweep grow with
/// the numbers of the rows J and of what each does to the bodies: six a row and body for rigid bodies and
/// points that answer alone, where W has a number for each pair of rows; all degrees of freedom of a body
/// that a linear solver answers for. The iterates are those of BlockGaussSeidelConstraintSolver.
struct UnbuiltGaussSeidelConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "UnbuiltGaussSeidelConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  double sor = 1;
  bool computeConstraintForces = false;

  static constexpr auto fields() {
    using S = UnbuiltGaussSeidelConstraintSolver;
    return sweeping_fields<S>(relaxation_field<S>());
  }

  static constexpr bool takesUnbuilt() { return true; }

  static constexpr auto outputs() { return constraint_forces_output<UnbuiltGaussSeidelConstraintSolver>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};

  std::string unsolved() const { return unsolved_by_sweeps(*this); }
  void solve(ConstraintProblem& problem, std::string_view where) {
    SweepSettings settings = sweep_settings(*this);
    settings.relaxation = sor;
    sweep(*this, problem, where, [&](auto& p) { return sweeps.gaussSeidel(p, settings, where); });
  }
};

}  // namespace sinew
