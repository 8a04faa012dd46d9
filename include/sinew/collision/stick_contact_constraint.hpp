// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact_constraint.hpp>

namespace sinew {

/// What has come as near as the contact distance stays where it has touched, by multipliers along the normal
/// and both tangents, for as long as it is found within the alarm distance: d = u - u0, with u0 at the
/// impact, or where it is found deeper than that. Needs a FreeMotionAnimationLoop in the root.
struct StickContactConstraint {
  static constexpr std::string_view className = "StickContactConstraint";

  void addRows(ConstraintRows& rows, Contact& c, ContactMotion const& m) const {
    FrictionState& state = c.frictionState;
    const Eigen::Vector3d end = rows.ofVelocity ? Eigen::Vector3d(m.start + m.dt * m.rate) : m.free;
    if (state.mode == FrictionState::Mode::apart) {
      const double before = gap_of(c, m.start), after = gap_of(c, end);
      if (before > 0 && after > 0) return;
      const double impact = before > 0 ? before / (before - after) : 0;
      state = {.mode = FrictionState::Mode::sticks, .slip = impact * (m.start - end)};
    }
    const Eigen::Vector3d d = contact_axes(c.normal).transpose() * (state.slip + (end - m.start));
    const int row = rows.addEquality(3);
    for (int i = 0; i < 3; ++i) rows.setViolation(row + i, rows.ofVelocity ? d[i] / m.dt : d[i]);
  }
  /// The slip is u - u0.
  void settle(Contact& c, Eigen::Vector3d const& u) const {
    if (c.frictionState.mode == FrictionState::Mode::sticks) c.frictionState.slip += u - c.start;
  }
};

}  // namespace sinew
