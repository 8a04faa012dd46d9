// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Gravity of the node and all below it, until another one takes its place.
struct Gravity {
  using Role = role::Context;
  static constexpr std::string_view className = "Gravity", aliases = "GravityForceField";

  Eigen::Vector3d gravity{0, -9.81, 0};

  static constexpr auto fields() {
    return field_list(field("gravity", &Gravity::gravity, "m/s^2", "acceleration of free fall")
                          .also("gravitationalAcceleration"));
  }
};

}  // namespace sinew
