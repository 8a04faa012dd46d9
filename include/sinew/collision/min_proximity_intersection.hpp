// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/proximity.hpp>
#include <sinew/core/component.hpp>

#include <optional>
#include <utility>

namespace sinew {

/// Contacts between primitives that are nearer to each other than the alarm distance, at their closest
/// points. The response acts from the contact distance on. Both are between the surfaces, radii and the
/// proximities of the two models taken off.
struct MinProximityIntersection {
  using Role = role::Intersection;
  static constexpr std::string_view className = "MinProximityIntersection";
  static constexpr std::string_view aliases = "NewProximityIntersection";
  static constexpr bool continuous = false;

  double alarmDistance = 1;
  double contactDistance = 0.5;

  static constexpr auto fields() { return proximity_fields<MinProximityIntersection>(); }

  SINEW_HD double reach() const { return std::max(alarmDistance, contactDistance); }
  double limit() const { return contactDistance; }

  template <Shape A, Shape B>
  std::optional<Contact> intersect(PrimitivePair<A, B> const& pair) const {
    std::optional<Contact> found(std::in_place);
    if (!find(pair, *found)) found.reset();
    return found;
  }
  /// The same for any surfaces, also in memory of a GPU; false where there is none.
  template <Shape A, Shape B, class SA, class SB>
  SINEW_HD bool find(PrimitivePair<A, B, SA, SB> const& pair, Contact& contact) const {
    const auto a = pair.cornersA();
    const auto b = pair.cornersB();
    const double far = reach() + pair.proximity() + pair.thickness();
    if constexpr (corners_of(A) + corners_of(B) > 3)
      if (are_apart(a, b, far)) return false;
    // as far behind a one-sided triangle as in front of it: what is farther is on the other side of the body
    if (!find_contact(pair, a, b, true, contact) || contact.start.norm() > far || !is_of_pair(pair, contact))
      return false;
    contact.limit = contactDistance + pair.proximity();
    return true;
  }
};

}  // namespace sinew
