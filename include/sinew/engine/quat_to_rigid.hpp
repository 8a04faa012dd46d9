// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Frames from points and orientations, one for each point or one for all. A point may be moved to the plane
/// across the z axis of its frame in which it lies, to the line of that axis through another point.
struct QuatToRigidEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "QuatToRigidEngine";

  std::vector<Eigen::Vector3d> positions{};
  std::vector<Eigen::Vector4d> orientations{};
  std::vector<Eigen::Vector3d> colinearPositions{};

  static constexpr auto fields() {
    using E = QuatToRigidEngine;
    return field_list(
        field("positions", &E::positions, "m", "centres of the frames").also("position"),
        field("orientations", &E::orientations, "", "quaternions x y z w").also("orientation"),
        field("colinearPositions", &E::colinearPositions, "m", "points of the lines to which frames move")
            .also("colinearPosition"));
  }

  Rigid3d::VecCoord rigids{};  // after update

  static constexpr auto outputs() {
    return field_list(field("rigids", &QuatToRigidEngine::rigids, "m", "the frames").also("rigid"));
  }

  /// Throws Error unless there is one orientation or one for each point, none of them zero; the output then
  /// stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

namespace sinew {

SINEW_ONCE void QuatToRigidEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  check_one_or_each(at, "orientations", orientations.size(), positions.size(), "positions", "one for all");
  for (std::size_t i = 0; i < orientations.size(); ++i)
    if (!(orientations[i].norm() > 1e-6))
      throw Error(at, text("orientation ", i, " is zero; give a quaternion of length 1"));
  rigids.clear();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    RigidCoord3<double> frame{positions[i], Quat<double>(one_or_each(orientations, i)).normalized()};
    if (i < colinearPositions.size()) {
      const Eigen::Vector3d axis = frame.orientation * Eigen::Vector3d::UnitZ();
      frame.center = colinearPositions[i] + axis * axis.dot(positions[i] - colinearPositions[i]);
    }
    rigids.push_back(frame);
  }
}

}  // namespace sinew
#endif
