// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/picking.hpp>

#include <limits>

namespace sinew {

/// Pulls what a pointer points at: press picks along a ray and attaches, move brings the other end of the
/// spring under the pointer, in the plane through the picked point that faced the viewer, release lets go.
struct MouseInteractor {
  AttachSettings spring{};
  double tolerance = 0;  // within which lines and points are picked [m]
  double maxDistance = std::numeric_limits<double>::infinity();

  std::optional<Pick> held{};  // what press has met, while it is attached
  Eigen::Vector3d facing{0, 0, 0};
  int attachment = 0;

  /// Whether something is held now; what was held before is released.
  template <class Sim>
  bool press(Sim& sim, Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) {
    release(sim);
    const auto met = sim.pick(origin, direction, maxDistance, tolerance);
    if (!met || !met->simulated) return false;
    attachment = sim.attach(*met, spring);
    held = met;
    facing = direction.normalized();
    return true;
  }
  /// False where nothing is held (any more), and where the ray does not meet the plane.
  template <class Sim>
  bool move(Sim& sim, Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) {
    if (!held) return false;
    const double towards = direction.dot(facing), depth = (held->point - origin).dot(facing);
    if (!(towards > 0) || !(depth > 0)) return false;
    if (!sim.pull(attachment, origin + direction * (depth / towards))) held.reset();
    return held.has_value();
  }
  template <class Sim>
  bool release(Sim& sim) {
    return std::exchange(held, std::nullopt).has_value() && sim.release(attachment);
  }
};

}  // namespace sinew
