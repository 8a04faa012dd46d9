// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The centres of frames and their orientations, as quaternions and as angles about x, y and z, in this
/// order.
struct RigidToQuatEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "RigidToQuatEngine";

  Rigid3d::VecCoord rigids{};

  static constexpr auto fields() {
    return field_list(field("rigids", &RigidToQuatEngine::rigids, "m", "the frames").also("rigid"));
  }

  // after update
  std::vector<Eigen::Vector3d> positions{};
  std::vector<Eigen::Vector4d> orientations{};
  std::vector<Eigen::Vector3d> orientationsEuler{};

  static constexpr auto outputs() {
    using E = RigidToQuatEngine;
    return field_list(field("positions", &E::positions, "m", "their centres").also("position"),
                      field("orientations", &E::orientations, "", "quaternions x y z w").also("orientation"),
                      field("orientationsEuler", &E::orientationsEuler, "rad", "three angles each"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE void RigidToQuatEngine::update(std::string_view where) {
  check_fields(*this, where);
  positions.clear(), orientations.clear(), orientationsEuler.clear();
  for (auto const& frame : rigids) {
    positions.push_back(frame.center);
    orientations.push_back(frame.orientation.coeffs());
    const double x = frame.orientation.x(), y = frame.orientation.y(), z = frame.orientation.z(),
                 w = frame.orientation.w();
    orientationsEuler.emplace_back(std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                                   std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
                                   std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)));
  }
}

}  // namespace sinew
#endif
