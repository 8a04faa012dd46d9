// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact_constraint.hpp>

namespace sinew {

/// Contact by multipliers: what touches neither comes nearer than the contact distance nor is drawn to it,
/// and slides only where friction cannot hold it (Signorini, Coulomb). With the gap g, the tangential
/// displacement s of a step, and the force f on b:
///   g >= 0, f_n >= 0, g f_n = 0;   |f_t| <= mu f_n,  f_t = -mu f_n s / |s| where s is not 0.
/// In a step with an impact s counts from there. Needs a FreeMotionAnimationLoop in the root.
struct FrictionContactConstraint {
  static constexpr std::string_view className = "FrictionContactConstraint";
  static constexpr std::string_view aliases = "FrictionContact AugmentedLagrangianResponseConstraint";
  /// SOFA's name of a response that iterates to the same contact by a penalty; without friction unless asked
  /// for.
  static constexpr std::string_view byPenalty = "AugmentedLagrangianResponseConstraint";

  double mu = 0.8;  // where neither responseParams nor the contactFriction of the models say it

  void addRows(ConstraintRows& rows, Contact const& c, ContactMotion const& m) const {
    const int row = c.friction > 0 ? rows.addContact(c.friction) : rows.addUnilateral();
    double d[3];
    violations(c, m, rows.ofVelocity, d);
    for (int i = 0; i < (c.friction > 0 ? 3 : 1); ++i) rows.setViolation(row + i, d[i]);
  }
  /// Of the normal, and of two tangents where there is friction.
  template <class C>
  SINEW_HD static void violations(C const& c, ContactMotion const& m, bool ofVelocity, double* d) {
    d[0] = ofVelocity ? gap_of(c, m.start) / m.dt + c.normal.dot(m.rate) : gap_of(c, m.free);
    if (!(c.friction > 0)) return;
    const Eigen::Matrix3d axes = contact_axes(c.normal);
    const Eigen::Vector3d slip =
        ofVelocity ? m.rate : Eigen::Vector3d(part_after_impact(c, m) * (m.free - m.start));
    for (int t = 1; t <= 2; ++t) d[t] = axes.col(t).dot(slip);
  }
};

}  // namespace sinew
