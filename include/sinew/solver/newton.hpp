// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// How Newton's method ended.
enum class NewtonStatus {
  notStarted,
  alreadyInEquilibrium,
  residualSmall,    // against one of its three thresholds
  correctionSmall,  // against one of its two thresholds
  outOfIterations,
  residualGrew,
  notFinite
};
inline constexpr std::array<std::string_view, 7> enum_names(NewtonStatus) {
  return {"notStarted",
          "alreadyInEquilibrium",
          "residualSmall",
          "correctionSmall",
          "outOfIterations",
          "residualGrew",
          "notFinite"};
}

/// What the iterations of the last step did. Nothing is measured in a step in time that has one iteration.
struct NewtonReport {
  std::vector<double> residuals{};    // |r| at the start of the step, then after each iteration
  std::vector<double> corrections{};  // |s dx| of each iteration
  NewtonStatus status = NewtonStatus::notStarted;

  bool converged() const {
    return status == NewtonStatus::alreadyInEquilibrium || status == NewtonStatus::residualSmall ||
           status == NewtonStatus::correctionSmall;
  }
  void init(int iterations) {
    *this = {};
    const auto room = std::size_t(std::min(iterations, 1'000'000));
    residuals.reserve(room + 1);
    corrections.reserve(room);
  }
};

/// The fields of a solver S that has Newton's method: its own, then those of the method, by SOFA's names of
/// today (NewtonRaphsonSolver) and of its StaticSolver before. Residuals and corrections have the units
/// given.
template <class S, class... Own>
constexpr auto newton_fields(std::string_view residual, std::string_view correction, Own... own) {
  return field_list(
      own...,
      field("maxNbIterationsNewton",
            &S::maxNbIterationsNewton,
            "",
            "largest number of iterations of Newton's method in a step",
            range::atLeast(1))
          .also("newton_iterations"),
      field("relativeSuccessiveStoppingThreshold",
            &S::relativeSuccessiveStoppingThreshold,
            "",
            "residual at which to stop, against that of the iteration before"),
      field("relativeInitialStoppingThreshold",
            &S::relativeInitialStoppingThreshold,
            "",
            "residual at which to stop, against that at the start of the step")
          .also("relative_residual_tolerance_threshold residual_tolerance_threshold"),
      field("absoluteResidualStoppingThreshold",
            &S::absoluteResidualStoppingThreshold,
            residual,
            "residual at which to stop")
          .also("absolute_residual_tolerance_threshold absoluteResidualToleranceThreshold"),
      field("relativeEstimateDifferenceThreshold",
            &S::relativeEstimateDifferenceThreshold,
            "",
            "correction at which to stop, against the sum of those in this step")
          .also("relative_correction_tolerance_threshold"),
      field("absoluteEstimateDifferenceThreshold",
            &S::absoluteEstimateDifferenceThreshold,
            correction,
            "correction at which to stop")
          .also("absolute_correction_tolerance_threshold correction_tolerance_threshold"),
      field("should_diverge_when_residual_is_growing",
            &S::shouldDivergeWhenResidualIsGrowing,
            "",
            "stop when the residual grows"),
      field("maxNbIterationsLineSearch",
            &S::maxNbIterationsLineSearch,
            "",
            "largest number of lengths of a correction to try, the whole one first; 0 and 1: no line search",
            range::nonNegative),
      field("lineSearchCoefficient",
            &S::lineSearchCoefficient,
            "",
            "each length against the one before",
            range::open(0, 1)));
}

/// Whether the residual is looked at again after the first iteration of a solver in time.
template <class Solver>
bool newton_goes_on(Solver const& solver) {
  return solver.maxNbIterationsNewton > 1 || solver.maxNbIterationsLineSearch > 1;
}

/// Solves r = 0 by Newton's method: A dx = r, where A = -dr/dx has the given factors, then advance(s) moves
/// the unknown by s dx. The length s is 1, or with a line search the first of 1, q, q^2... (q =
/// lineSearchCoefficient, down to the precision of a double) that makes |r| smaller than it was, and 1 again
/// where none does. `evaluate()` puts r at the unknown into b; `way` is made the sum of the corrections. A
/// threshold of 0 or less is not looked at. A search for an equilibrium may find it at its start, and looks
/// at where it ends in any case.
template <class Solver, class Operations, class Evaluate, class Advance>
void newton(Solver& solver, Operations& operations, MatrixFactors factors, bool equilibrium,
            MultiVecDeriv<Operations>& dx, MultiVecDeriv<Operations>& b, MultiVecDeriv<Operations>& way,
            Evaluate&& evaluate, Advance&& advance) {
  constexpr double lost = std::numeric_limits<double>::epsilon();
  auto& [residuals, corrections, status] = solver.newton;
  auto below = [](double value, double threshold) {
    return value == 0 || (threshold > 0 && value <= threshold);
  };
  auto residual = [&] {
    evaluate();
    return b.norm();
  };
  auto move = [&](double s) {
    way.peq(dx, s);
    advance(s);
  };
  auto solve = [&] {
    operations.root.withLinearSolver([&](auto& linear) { linear.solve(operations, factors, dx, b); });
  };
  residuals.clear();
  corrections.clear();
  status = NewtonStatus::outOfIterations;
  if (!equilibrium && !newton_goes_on(solver)) {
    evaluate();
    solve();
    way.eq(dx);
    advance(1);
    return;
  }
  way.clear();
  residuals.push_back(residual());
  if (equilibrium && below(residuals[0], solver.absoluteResidualStoppingThreshold)) {
    status = NewtonStatus::alreadyInEquilibrium;
    return;
  }
  while (status == NewtonStatus::outOfIterations && int(corrections.size()) < solver.maxNbIterationsNewton) {
    solve();
    move(1);
    const double last = residuals.back();
    double size = residual(), s = 1;
    for (int i = 1; i < solver.maxNbIterationsLineSearch && !(size < last) && s > lost; ++i) {
      const double shorter = s * solver.lineSearchCoefficient;
      move(shorter - s);
      s = shorter;
      size = residual();
    }
    if (s != 1 && !(size < last)) {
      move(1 - s);
      s = 1;
      size = residual();
    }
    const double correction = s * dx.norm();
    residuals.push_back(size);
    corrections.push_back(correction);

    if (!std::isfinite(size) || !std::isfinite(correction))
      status = NewtonStatus::notFinite;
    else if (solver.shouldDivergeWhenResidualIsGrowing && size > last)
      status = NewtonStatus::residualGrew;
    else if (below(size, solver.absoluteResidualStoppingThreshold) ||
             below(size, solver.relativeInitialStoppingThreshold * residuals[0]) ||
             below(size, solver.relativeSuccessiveStoppingThreshold * last))
      status = NewtonStatus::residualSmall;
    else if (below(correction, solver.absoluteEstimateDifferenceThreshold) ||
             below(correction, solver.relativeEstimateDifferenceThreshold * way.norm()))
      status = NewtonStatus::correctionSmall;
  }
}

}  // namespace sinew
