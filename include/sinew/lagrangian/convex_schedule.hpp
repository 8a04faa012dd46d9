// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/lagrangian/contact_potential.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>

#include <limits>

namespace sinew {

/// What is decided between two convex problems of a step with constraints (ConvexUpdates), from numbers
/// alone, so that a GPU decides by the same function.
struct ConvexSchedule {
  /// What becomes of the potentials: they move to the multipliers found; that is accelerated; or the other
  /// part of Coulomb's law is lagged from the start.
  enum class Next { move, accelerate, change };

  double relative = 0;                      // of r, the regularisation
  double last = infinite, best = infinite;  // residuals
  int since = 0;                            // updates since the best
  bool accelerating = false;

  SINEW_HD void begin(ConvexStepSettings const& s) {
    relative = s.regularisation > s.firstRegularisation ? s.regularisation : s.firstRegularisation;
    last = best = infinite;
    since = 0;
    accelerating = false;
  }
  /// Behind a problem with this residual. rest() is how far the potentials are from the conditions
  /// (contact_potential::Rest); `forgets`: what an acceleration has learnt is of another function.
  template <class Rest>
  SINEW_HD Next next(ConvexStepSettings const& s, FrictionLag lag, double residual, Rest&& rest,
                     bool& forgets) {
    forgets = false;
    if (residual < 0.5 * best) {
      best = residual;
      since = 0;
    } else if (++since == s.patience && lag != FrictionLag::none) {
      begin(s);
      forgets = true;
      return Next::change;
    }
    const double contraction = residual / last;
    last = residual;
    if (relative > s.regularisation) {
      decrease(s, s.regularisation);
    } else if (contraction > 0.3) {
      const contact_potential::Rest of = rest();
      if (of.regularisation > of.lag && relative > s.leastRegularisation) {
        decrease(s, s.leastRegularisation);
        forgets = true;
      } else {
        accelerating = true;
      }
    }
    return accelerating && lag == FrictionLag::bound ? Next::accelerate : Next::move;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  SINEW_HD void decrease(ConvexStepSettings const& s, double least) {
    relative *= s.decrease;
    if (relative < least) relative = least;
  }
};

/// Constraints that contradict each other have multipliers that grow with each problem, until rounding has
/// the motion: the last solution of a problem that is about as good as any is kept.
struct ConvexBest {
  double residual = std::numeric_limits<double>::infinity(), momentum = 0;

  enum class Found { good, worse, farWorse };
  SINEW_HD Found look(double newResidual, double newMomentum) {
    if (newResidual > 1000 * residual) return Found::farWorse;
    if (newResidual > 1.1 * residual) return Found::worse;
    residual = newResidual;
    momentum = newMomentum;
    return Found::good;
  }
};

}  // namespace sinew
