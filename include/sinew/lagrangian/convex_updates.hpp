// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/anderson_acceleration.hpp>
#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>

#include <Eigen/Core>

namespace sinew {

/// What happens between the convex problems of a step with constraints (ConvexStep), however each of them is
/// solved: the regularisation decreases, the potentials move to the multipliers found, where that converges
/// slowly it is accelerated, and where it does not converge the other part of Coulomb's law is lagged.
struct ConvexUpdates {
  ConstraintTerms terms{};
  Eigen::VectorXd compliance{};  // estimate of the diagonal of W

  /// The first problem: behind terms.begin and the estimate.
  void begin(ConvexStepSettings const& settings);
  double residual() const { return terms.residual(compliance); }
  /// The next problem, from the violations and multipliers of the last one, and its residual.
  void update(ConvexStepSettings const& settings, double residual);

 private:
  AndersonAcceleration acceleration_{};
  Eigen::VectorXd next_{};  // g of the next problem
  double relative_ = 0;     // of r, the regularisation
  bool accelerating_ = false;
  double last_ = 0, best_ = 0;  // residuals
  int since_ = 0;               // updates since the best

  void regularise(double relative);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <limits>

namespace sinew {

SINEW_ONCE void ConvexUpdates::regularise(double relative) {
  relative_ = relative;
  for (ConstraintBlock const& b : terms.blocks())
    if (b.kind == ConstraintBlock::Kind::friction)
      terms.regularisation.segment<3>(b.first).setConstant(relative * compliance.segment<3>(b.first).mean());
    else
      terms.regularisation.segment(b.first, b.rows) = relative * compliance.segment(b.first, b.rows);
}

SINEW_ONCE void ConvexUpdates::begin(ConvexStepSettings const& settings) {
  acceleration_.reset(terms.rows().rows());
  accelerating_ = false;
  since_ = 0;
  last_ = best_ = std::numeric_limits<double>::infinity();
  regularise(std::max(settings.regularisation, settings.firstRegularisation));
}

SINEW_ONCE void ConvexUpdates::update(ConvexStepSettings const& settings, double residual) {
  if (residual < 0.5 * best_) {
    best_ = residual;
    since_ = 0;
  } else if (++since_ == settings.patience && terms.lag() != FrictionLag::none) {
    begin(settings);
    terms.change(terms.lag() == FrictionLag::gap ? FrictionLag::bound : FrictionLag::gap);
    return;
  }
  const double contraction = residual / last_;
  last_ = residual;
  next_ = terms.multipliers;
  if (relative_ > settings.regularisation) {
    regularise(std::max(settings.regularisation, settings.decrease * relative_));
  } else if (contraction > 0.3) {
    const auto rest = terms.rest(compliance);
    if (rest.regularisation > rest.lag && relative_ > settings.leastRegularisation) {
      regularise(std::max(settings.leastRegularisation, settings.decrease * relative_));
      acceleration_.reset(terms.rows().rows());
    } else {
      accelerating_ = true;
    }
  }
  if (accelerating_ && terms.lag() == FrictionLag::bound) {
    next_ = terms.before;
    acceleration_.next(terms.multipliers, compliance, next_);
  }
  terms.update(next_);
}

}  // namespace sinew
#endif
