// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// How a search for an equilibrium ended.
enum class NewtonStatus {
  notStarted,
  alreadyInEquilibrium,
  residualSmall,    // against one of its two thresholds
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

/// Equilibrium, f(x) = 0 with forces at rest, by Newton's method: K dx = -f, x += s dx. The factor s is 1, or
/// with a line search the first of 1, q, q^2... (q = lineSearchCoefficient) that makes |f| smaller than it
/// was. A threshold of 0 or less is not looked at. What each iteration did can be read from `residuals`,
/// `corrections` and `status`; a search that does not converge leaves the positions of its last iteration.
struct StaticSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "StaticSolver";
  static constexpr std::string_view aliases = "StaticOdeSolver StaticEquilibriumIntegrationScheme";
  static constexpr bool implicit = true;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 1};

  int newtonIterations = 1;
  double absoluteCorrectionToleranceThreshold = 1e-5;
  double relativeCorrectionToleranceThreshold = 1e-5;
  double absoluteResidualToleranceThreshold = 1e-5;
  double relativeResidualToleranceThreshold = 1e-5;
  bool shouldDivergeWhenResidualIsGrowing = false;
  int maxNbIterationsLineSearch = 0;
  double lineSearchCoefficient = 0.5;

  static constexpr auto fields() {
    using S = StaticSolver;
    return field_list(field("newton_iterations",
                            &S::newtonIterations,
                            "",
                            "largest number of iterations in a step",
                            range::atLeast(1))
                          .also("maxNbIterationsNewton"),
                      field("absolute_correction_tolerance_threshold",
                            &S::absoluteCorrectionToleranceThreshold,
                            "m",
                            "correction |dx| at which to stop")
                          .also("correction_tolerance_threshold"),
                      field("relative_correction_tolerance_threshold",
                            &S::relativeCorrectionToleranceThreshold,
                            "",
                            "correction |dx| at which to stop, against the displacement in this step"),
                      field("absolute_residual_tolerance_threshold",
                            &S::absoluteResidualToleranceThreshold,
                            "N",
                            "residual |f| at which to stop"),
                      field("relative_residual_tolerance_threshold",
                            &S::relativeResidualToleranceThreshold,
                            "",
                            "residual |f| at which to stop, against that at the start of the step")
                          .also("residual_tolerance_threshold"),
                      field("should_diverge_when_residual_is_growing",
                            &S::shouldDivergeWhenResidualIsGrowing,
                            "",
                            "stop when the residual grows"),
                      field("maxNbIterationsLineSearch",
                            &S::maxNbIterationsLineSearch,
                            "",
                            "largest number of shorter corrections to try; 0: no line search",
                            range::nonNegative),
                      field("lineSearchCoefficient",
                            &S::lineSearchCoefficient,
                            "",
                            "each of them against the one before",
                            range::open(0, 1)));
  }

  std::vector<double> residuals{};    // |f| of the last step: at its start, then after each iteration [N]
  std::vector<double> corrections{};  // |s dx| of each iteration [m]
  NewtonStatus status = NewtonStatus::notStarted;

  bool converged() const {
    return status == NewtonStatus::alreadyInEquilibrium || status == NewtonStatus::residualSmall ||
           status == NewtonStatus::correctionSmall;
  }

  template <class Operations>
  void init(Operations&) {
    residuals.clear();
    corrections.clear();
    status = NewtonStatus::notStarted;
    residuals.reserve(std::size_t(newtonIterations) + 1);
    corrections.reserve(std::size_t(newtonIterations));
  }

  template <class Operations>
  void solve(Operations& operations, double) {
    MultiVecCoord pos(operations, vec_id::position), before(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force),
        dx(operations, vec_id::dx);
    MultiVecDeriv way(operations);
    auto residual = [&] {
      operations.propagate(pos.id, vel.id);
      operations.computeForce(force.id, pos.id, vel.id);
      operations.projectResponse(force.id);
      return force.norm();
    };
    auto below = [](double value, double threshold) { return threshold > 0 && value <= threshold; };

    residuals.clear();
    corrections.clear();
    vel.clear();
    way.clear();
    residuals.push_back(residual());
    if (below(residuals[0], absoluteResidualToleranceThreshold)) {
      status = NewtonStatus::alreadyInEquilibrium;
      return;
    }
    status = NewtonStatus::outOfIterations;
    while (status == NewtonStatus::outOfIterations && int(corrections.size()) < newtonIterations) {
      operations.root.withLinearSolver([&](auto& linear) { linear.solve(operations, {.k = -1}, dx, force); });
      const double last = residuals.back();
      if (maxNbIterationsLineSearch > 0) before = pos;
      pos.peq(dx);
      double size = residual();
      for (int i = 0; i < maxNbIterationsLineSearch && !(size < last); ++i) {
        dx.teq(lineSearchCoefficient);
        pos = before;
        pos.peq(dx);
        size = residual();
      }
      way.peq(dx);
      const double correction = dx.norm();
      residuals.push_back(size);
      corrections.push_back(correction);

      if (!std::isfinite(size) || !std::isfinite(correction))
        status = NewtonStatus::notFinite;
      else if (shouldDivergeWhenResidualIsGrowing && size > last)
        status = NewtonStatus::residualGrew;
      else if (below(size, absoluteResidualToleranceThreshold) ||
               below(size, relativeResidualToleranceThreshold * residuals[0]))
        status = NewtonStatus::residualSmall;
      else if (below(correction, absoluteCorrectionToleranceThreshold) ||
               below(correction, relativeCorrectionToleranceThreshold * way.norm()))
        status = NewtonStatus::correctionSmall;
    }
  }
};

}  // namespace sinew
