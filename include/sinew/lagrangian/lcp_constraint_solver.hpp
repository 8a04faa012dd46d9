// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Block Gauss-Seidel over the compliance W for contacts (Duriez et al. 2006), with one coefficient of
/// friction for all of them in the place of their own; where it is zero a linear complementarity problem is
/// left, and the iteration is projected Gauss-Seidel. Other constraints are solved as they are.
struct LCPConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "LCPConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double mu = 0.6;
  bool initial_guess = true;
  double regularizationTerm = 0;
  bool stopsUnsolved = false;
  static constexpr bool scaleTolerance = true, allVerified = false;

  static constexpr auto fields() {
    using S = LCPConstraintSolver;
    return field_list(
        field("maxIt", &S::maxIterations, "", "largest number of iterations", range::atLeast(1)),
        field("tolerance",
              &S::tolerance,
              "m",
              "change of the violations in an iteration at which to stop, for each equation",
              range::nonNegative),
        field("mu", &S::mu, "", "coefficient of Coulomb's friction of all contacts", range::nonNegative),
        field("initial_guess", &S::initial_guess, "", "start from the multipliers of the last step"),
        field("regularizationTerm",
              &S::regularizationTerm,
              "m/N",
              "added to the compliance of each equation",
              range::nonNegative),
        field("stopsUnsolved",
              &S::stopsUnsolved,
              "",
              "an Error where the iterations end above the tolerance; else the step goes on with what they "
              "have found"));
  }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};

  void solve(ConstraintProblem& problem, std::string_view where) {
    for (ConstraintBlock& block : problem.blocks)
      if (block.kind == ConstraintBlock::Kind::friction) block.friction = mu;
    if (!initial_guess) problem.multipliers.setZero();
    sweep(
        *this, problem, where, [&](auto& p) { return sweeps.gaussSeidel(p, sweep_settings(*this), where); });
  }
};

}  // namespace sinew
