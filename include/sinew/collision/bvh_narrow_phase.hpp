// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/component.hpp>

namespace sinew {

/// Pairs of primitives whose boxes overlap, found in the hierarchies of boxes of the two models; they are
/// refitted each step, and built anew where they have grown too loose.
struct BVHNarrowPhase {
  using Role = role::NarrowPhase;
  static constexpr std::string_view className = "BVHNarrowPhase";
  static constexpr std::string_view aliases = "ParallelBVHNarrowPhase";

  static constexpr auto fields() { return field_list(); }

  /// f(element of a, element of b); within one model each pair once.
  template <class F>
  void pairs(CollisionSurface const& a, CollisionSurface const& b, F&& f) {
    if (&a == &b)
      a.tree.self_pairs(0, f);
    else
      a.tree.pairs(b.tree, 0, f);
  }
};

}  // namespace sinew
