// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Block Gauss-Seidel that in SOFA asks the bodies for what a block changes instead of a compliance W. The
/// iterates are the same; here they come from W, so that it is BlockGaussSeidelConstraintSolver by another
/// name.
struct UnbuiltGaussSeidelConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "UnbuiltGaussSeidelConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  double sor = 1;

  static constexpr auto fields() {
    using S = UnbuiltGaussSeidelConstraintSolver;
    return sweeping_fields<S>(
        field("sor", &S::sor, "", "relaxation of the multipliers", range::closed(0, 2)));
  }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};

  void solve(ConstraintProblem& problem, std::string_view where) {
    SweepSettings settings = sweep_settings(*this);
    settings.relaxation = sor;
    sweep(*this, problem, where, [&](auto& p) { return sweeps.gaussSeidel(p, settings, where); });
  }
};

}  // namespace sinew
