// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/component.hpp>

#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Each pair of models whose boxes overlap, found by comparing all: for some dozens of models.
struct BruteForceBroadPhase {
  using Role = role::BroadPhase;
  static constexpr std::string_view className = "BruteForceBroadPhase";
  static constexpr std::string_view aliases = "BruteForceDetection ParallelBruteForceBroadPhase";

  static constexpr auto fields() { return field_list(); }

  /// f(i, j), i <= j, in rising order; a model and itself too.
  template <class F>
  void pairs(std::span<CollisionSurface* const> surfaces, F&& f) {
    for (int i = 0; i < int(surfaces.size()); ++i)
      for (int j = i; j < int(surfaces.size()); ++j)
        if (surfaces[std::size_t(i)]->box.overlaps(surfaces[std::size_t(j)]->box)) f(i, j);
  }
};

}  // namespace sinew
