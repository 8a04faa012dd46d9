// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/overlap.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/core/component.hpp>

namespace sinew {

/// Contacts between primitives that overlap: spheres by their radii, lines and triangles by crossing.
struct DiscreteIntersection {
  using Role = role::Intersection;
  static constexpr std::string_view className = "DiscreteIntersection";
  static constexpr bool continuous = false;

  static constexpr auto fields() { return field_list(); }

  static double reach() { return 0; }
  static double limit() { return 0; }

  template <Shape A, Shape B>
  std::optional<Contact> intersect(PrimitivePair<A, B> const& pair) const {
    const auto a = pair.cornersA();
    const auto b = pair.cornersB();
    if (pair.thickness() == 0 && !overlap(a, b)) return std::nullopt;
    auto contact = contact_at(pair, a, b);
    if (!contact || contact->distance > pair.proximity()) return std::nullopt;
    contact->limit = pair.proximity();
    return contact;
  }
};

}  // namespace sinew
