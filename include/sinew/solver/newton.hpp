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
    const auto capacity = std::size_t(std::min(iterations, 1'000'000));
    residuals.reserve(capacity + 1);
    corrections.reserve(capacity);
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

/// The values of those fields: when the method stops, and which lengths of a correction it tries.
struct NewtonSettings {
  int maxNbIterationsNewton;
  double relativeSuccessiveStoppingThreshold, relativeInitialStoppingThreshold,
      absoluteResidualStoppingThreshold, relativeEstimateDifferenceThreshold,
      absoluteEstimateDifferenceThreshold;
  bool shouldDivergeWhenResidualIsGrowing;
  int maxNbIterationsLineSearch;
  double lineSearchCoefficient;
};
template <class Solver>
NewtonSettings newton_settings(Solver const& s) {
  return {s.maxNbIterationsNewton,
          s.relativeSuccessiveStoppingThreshold,
          s.relativeInitialStoppingThreshold,
          s.absoluteResidualStoppingThreshold,
          s.relativeEstimateDifferenceThreshold,
          s.absoluteEstimateDifferenceThreshold,
          s.shouldDivergeWhenResidualIsGrowing,
          s.maxNbIterationsLineSearch,
          s.lineSearchCoefficient};
}

/// Whether the residual is looked at again after the first iteration of a solver in time.
template <class Settings>
bool newton_goes_on(Settings const& settings) {
  return settings.maxNbIterationsNewton > 1 || settings.maxNbIterationsLineSearch > 1;
}

/// The linear system A dx = b of each iteration, where A = -dr/dx has the given factors and b is r;
/// `increment` becomes the sum of the corrections. A search for an equilibrium may end at its start, and
/// evaluates the residual at its end in any case.
template <class Operations>
struct NewtonSystem {
  MatrixFactors factors;
  MultiVecDeriv<Operations>&dx, &b, &increment;
  bool equilibrium = false;
};

/// evaluate() puts r at the unknown into b; advance(s) moves the unknown by s dx.
template <class Evaluate, class Advance>
struct NewtonCallbacks {
  Evaluate evaluate;
  Advance advance;
};
template <class Evaluate, class Advance>
NewtonCallbacks(Evaluate, Advance) -> NewtonCallbacks<Evaluate, Advance>;

namespace detail {

template <class Operations, class Callbacks>
struct NewtonSearch {
  NewtonSettings settings;
  NewtonReport& report;
  Operations& operations;
  NewtonSystem<Operations> const& system;
  Callbacks& callbacks;

  void run() {
    report.residuals.clear();
    report.corrections.clear();
    report.status = NewtonStatus::outOfIterations;
    if (!system.equilibrium && !newton_goes_on(settings)) return iterateOnce();
    system.increment.clear();
    report.residuals.push_back(residual());
    if (system.equilibrium && below(report.residuals[0], settings.absoluteResidualStoppingThreshold)) {
      report.status = NewtonStatus::alreadyInEquilibrium;
      return;
    }
    while (report.status == NewtonStatus::outOfIterations &&
           int(report.corrections.size()) < settings.maxNbIterationsNewton)
      iterate();
  }

 private:
  static bool below(double value, double threshold) {
    return value == 0 || (threshold > 0 && value <= threshold);
  }

  // without a look at residuals
  void iterateOnce() {
    callbacks.evaluate();
    solve();
    system.increment.eq(system.dx);
    callbacks.advance(1);
  }
  void iterate() {
    solve();
    move(1);
    const double last = report.residuals.back();
    double size = residual();
    const double correction = searchLine(last, size) * system.dx.norm();
    report.residuals.push_back(size);
    report.corrections.push_back(correction);
    report.status = judge(size, correction, last);
  }

  void solve() { operations.solveSystem(system.factors, system.dx, system.b); }
  void move(double s) {
    system.increment.peq(system.dx, s);
    callbacks.advance(s);
  }
  double residual() {
    callbacks.evaluate();
    return system.b.norm();
  }

  // the length of the correction, of which the whole is taken already; `size` is made |r| there
  double searchLine(double last, double& size) {
    constexpr double lost = std::numeric_limits<double>::epsilon();
    double s = 1;
    auto take = [&](double length) {
      move(length - s);
      s = length;
      size = residual();
    };
    for (int i = 1; i < settings.maxNbIterationsLineSearch && !(size < last) && s > lost; ++i)
      take(s * settings.lineSearchCoefficient);
    if (s != 1 && !(size < last)) take(1);
    return s;
  }

  NewtonStatus judge(double size, double correction, double last) const {
    if (!std::isfinite(size) || !std::isfinite(correction)) return NewtonStatus::notFinite;
    if (settings.shouldDivergeWhenResidualIsGrowing && size > last) return NewtonStatus::residualGrew;
    if (below(size, settings.absoluteResidualStoppingThreshold) ||
        below(size, settings.relativeInitialStoppingThreshold * report.residuals[0]) ||
        below(size, settings.relativeSuccessiveStoppingThreshold * last))
      return NewtonStatus::residualSmall;
    if (below(correction, settings.absoluteEstimateDifferenceThreshold) ||
        below(correction, settings.relativeEstimateDifferenceThreshold * system.increment.norm()))
      return NewtonStatus::correctionSmall;
    return NewtonStatus::outOfIterations;
  }
};

}  // namespace detail

/// Solves r = 0 by Newton's method: A dx = r, then the unknown moves by s dx. The length s is 1, or with a
/// line search the first of 1, q, q^2... (q = lineSearchCoefficient, down to the precision of a double) that
/// makes |r| smaller than it was, and 1 again where none does. A threshold of 0 or less is ignored.
template <class Solver, class Operations, class Evaluate, class Advance>
void newton(Solver& solver, Operations& operations, NewtonSystem<Operations> const& system,
            NewtonCallbacks<Evaluate, Advance> callbacks) {
  detail::NewtonSearch<Operations, NewtonCallbacks<Evaluate, Advance>>{
      newton_settings(solver), solver.newton, operations, system, callbacks}
      .run();
}

}  // namespace sinew
