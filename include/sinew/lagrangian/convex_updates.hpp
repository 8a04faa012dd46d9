// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/anderson_acceleration.hpp>
#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/convex_schedule.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>

#include <Eigen/Core>

namespace sinew {

/// What happens between the convex problems of a step with constraints (ConvexStep), however each of them is
/// solved: the regularisation decreases, the potentials move to the multipliers found, where that converges
/// slowly it is accelerated, and where it does not converge the other part of Coulomb's law is lagged.
struct ConvexUpdates {
  ConstraintTerms terms{};
  Eigen::VectorXd compliance{};  // estimate of the diagonal of W
  ConvexSchedule schedule{};

  /// The first problem: behind terms.begin and the estimate.
  void begin(ConvexStepSettings const& settings);
  double residual() const { return terms.residual(compliance); }
  /// What the acceleration has learnt is of another step.
  void forget() { acceleration_.reset(terms.rows().rows()); }
  /// The next problem, from the violations and multipliers of the last one, and its residual.
  void update(ConvexStepSettings const& settings, double residual);

 private:
  AndersonAcceleration acceleration_{};
  Eigen::VectorXd next_{};  // g of the next problem

  void regularise();
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void ConvexUpdates::regularise() {
  for (ConstraintBlock const& b : terms.blocks())
    contact_potential::regularise(
        b, schedule.relative, compliance.data() + b.first, terms.regularisation.data() + b.first);
}

SINEW_ONCE void ConvexUpdates::begin(ConvexStepSettings const& settings) {
  acceleration_.reset(terms.rows().rows());
  schedule.begin(settings);
  regularise();
}

SINEW_ONCE void ConvexUpdates::update(ConvexStepSettings const& settings, double residual) {
  using Next = ConvexSchedule::Next;
  bool forgets = false;
  const Next then = schedule.next(
      settings, terms.lag(), residual, [&] { return terms.rest(compliance); }, forgets);
  regularise();
  if (forgets) acceleration_.reset(terms.rows().rows());
  if (then == Next::change)
    return terms.change(terms.lag() == FrictionLag::gap ? FrictionLag::bound : FrictionLag::gap);
  next_ = terms.multipliers;
  if (then == Next::accelerate) {
    next_ = terms.before;
    acceleration_.next(terms.multipliers, compliance, next_);
  }
  terms.update(next_);
}

}  // namespace sinew
#endif
