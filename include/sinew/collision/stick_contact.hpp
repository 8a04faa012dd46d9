// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>

namespace sinew {

/// What has come nearer than the contact distance sticks there, by springs along and across the surface,
/// until it is pulled away farther than the alarm distance: F = -k (u - u0) - c u', u0 from the first touch.
struct StickContactForceField {
  static constexpr std::string_view className = "StickContactForceField";
  static constexpr std::string_view aliases = "stick StickContact";

  double dt = 0;

  void evaluate(Contact& c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate) const;
  /// The slip is u - u0.
  void settle(Contact& c, Eigen::Vector3d const& u) const {
    if (!holds(c)) return;
    c.frictionState = {.mode = FrictionState::Mode::sticks, .slip = c.frictionState.slip + (u - c.start)};
  }

 private:
  static bool holds(Contact const& c) {
    return c.frictionState.mode != FrictionState::Mode::apart || c.distance < c.limit;
  }
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void StickContactForceField::evaluate(Contact& c, Eigen::Vector3d const& u,
                                                 Eigen::Vector3d const& rate) const {
  c.evaluated.setZero();
  c.stiffnessMatrix.setZero();
  c.dampingMatrix.setZero();
  if (!holds(c)) return;
  c.evaluated = -c.stiffness * (c.frictionState.slip + (u - c.start)) - c.damping * rate;
  c.stiffnessMatrix.diagonal().setConstant(c.stiffness);
  c.dampingMatrix.diagonal().setConstant(c.damping);
}

}  // namespace sinew
#endif
