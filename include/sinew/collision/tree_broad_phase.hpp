// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/broad_phase.hpp>
#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/component.hpp>

#include <span>
#include <vector>

namespace sinew {

/// Each pair of models whose boxes overlap, found in a tree over the boxes that is kept from step to step:
/// for hundreds of models and more. Where SOFA's scenes ask for a sweep, they get this, which has no bad case
/// (docs/performance.md).
struct TreeBroadPhase {
  using Role = role::BroadPhase;
  static constexpr std::string_view className = "TreeBroadPhase";
  static constexpr std::string_view aliases = "IncrSAP DirectSAP";

  static constexpr auto fields() { return field_list(); }

  std::vector<AxisBox> boxes{};
  BroadPhase search{};

  /// f(i, j), i <= j: a model and itself first, then pairs in rising order.
  template <class F>
  void pairs(std::span<CollisionSurface* const> surfaces, F&& f) {
    boxes.clear();
    for (auto const* s : surfaces) boxes.push_back(s->box);
    for (int i = 0; i < int(boxes.size()); ++i)
      if (!boxes[std::size_t(i)].empty()) f(i, i);
    for (auto const& pair : search.pairs(boxes, 0)) f(int(pair.first), int(pair.second));
  }
};

}  // namespace sinew
