// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/conjugate_residuals.hpp>
#include <sinew/lagrangian/sweeping_solver.hpp>

#include <algorithm>

namespace sinew {

/// Equalities by the method of conjugate residuals over the compliance W, with its diagonal on both sides as
/// preconditioner, in as many iterations as there are equations at most. It starts from no force in each
/// step. Contacts and one-sided constraints, which SOFA's takes for equalities, are an Error: what touches
/// would stick.
struct PreconditionedConjugateResidual {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "PreconditionedConjugateResidual";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool useSVDForRegularization = false;
  double svdSingularValueNullSpaceCriteriaFactor = 0.01, svdSingularVectorNullSpaceCriteriaFactor = 0.001;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  bool computeConstraintForces = false;

  static constexpr auto fields() { return sweeping_fields<PreconditionedConjugateResidual>(); }

  static constexpr auto outputs() { return constraint_forces_output<PreconditionedConjugateResidual>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  int refusedRow = -1;   // of what is no equality
  ConjugateResiduals residuals{};
  NullSpaceRows dependent{};

  std::string unsolved() const { return unsolved_by_sweeps(*this); }
  void solve(ConstraintProblem& problem, std::string_view where) {
    result = {};
    refusedRow = -1;
    for (ConstraintBlock const& b : problem.blocks)
      if (b.kind != ConstraintBlock::Kind::equality) {
        refusedRow = b.first;
        throw Error(where,
                    text(className,
                         ": it solves equalities only, and an equation is one-sided or a contact; take "
                         "BlockGaussSeidelConstraintSolver"));
      }
    sweep(*this, problem, where, [&](auto& p) { return residuals.solve(p, sweep_settings(*this), where); });
  }
};

}  // namespace sinew
