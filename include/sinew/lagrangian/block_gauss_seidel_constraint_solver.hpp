// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Block Gauss-Seidel over the compliance W of all constraints (Duriez et al. 2006): each block in turn is
/// solved for its own multipliers, those of the others as they are.
struct BlockGaussSeidelConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "BlockGaussSeidelConstraintSolver";
  static constexpr std::string_view aliases = "GenericConstraintSolver ProjectedGaussSeidelConstraintSolver";
  static constexpr bool takenByDefault = true;

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool useSVDForRegularization = false;
  double svdSingularValueNullSpaceCriteriaFactor = 0.01, svdSingularVectorNullSpaceCriteriaFactor = 0.001;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  double sor = 1;
  bool computeConstraintForces = false;

  static constexpr auto fields() {
    using S = BlockGaussSeidelConstraintSolver;
    return sweeping_fields<S>(relaxation_field<S>());
  }

  static constexpr auto outputs() { return constraint_forces_output<BlockGaussSeidelConstraintSolver>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};
  NullSpaceRows dependent{};

  std::string unsolved() const { return unsolved_by_sweeps(*this); }
  void solve(ConstraintProblem& problem, std::string_view where) {
    SweepSettings settings = sweep_settings(*this);
    settings.relaxation = sor;
    sweep(*this, problem, where, [&](auto& p) { return sweeps.gaussSeidel(p, settings, where); });
  }
};

}  // namespace sinew
