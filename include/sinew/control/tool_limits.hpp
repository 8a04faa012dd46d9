// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/control/haptic_controller.hpp>

#include <string_view>

namespace sinew {

/// Gives a tool the limits that contacts by multipliers set it, so that the haptic loop does not take it
/// through what the simulation holds it at, between two of its steps: for ToolState::limits, after the step.
/// `path`: of the node of the tool, at or below which its collision models are. What pushes is at its limit;
/// of other contacts the motion without multipliers says how far it is.
template <class Manager>
void add_tool_limits(ToolState& tool, Manager const& manager, std::string_view path) {
  auto isTool = [&](ContactSide const& side) {
    std::string_view at = manager.surfaces[std::size_t(side.surface)]->path;
    return at.starts_with(path) && (at.size() == path.size() || at[path.size()] == '/');
  };
  for (Contact const& c : manager.contacts) {
    const bool ofA = isTool(c.a), ofB = isTool(c.b);
    if (c.row < 0 || ofA == ofB) continue;
    ContactSide const& side = ofA ? c.a : c.b;
    const Eigen::Vector3d n = ofA ? Eigen::Vector3d(-c.normal) : c.normal;
    const Eigen::Vector3d lever =
        position_of(side, *manager.surfaces[std::size_t(side.surface)]) - tool.pose.center;
    ToolLimit limit;
    limit.direction << n, lever.cross(n);
    if (!(c.force.dot(c.normal) > 0))
      limit.distance = std::max(0.0, c.normal.dot(c.motion.free) - c.thickness - c.limit);
    tool.add(limit);
  }
}

}  // namespace sinew
