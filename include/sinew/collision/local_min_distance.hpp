// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/proximity.hpp>
#include <sinew/collision/surface_cones.hpp>
#include <sinew/core/component.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace sinew {

/// Contacts at the places where the distance of two bodies is least among all places around, each once: what
/// constraints by multipliers need to keep bodies apart. Two primitives meet inside both, points at points,
/// lines and triangles, lines at lines, and each in the cone of the other (SurfaceCones). What is behind a
/// one-sided triangle is not found, so the contact distance has to be more than a step goes. The response
/// acts from the contact distance on. Distances are between the surfaces, radii and the proximities of the
/// two models taken off.
struct LocalMinDistance {
  using Role = role::Intersection;
  static constexpr std::string_view className = "LocalMinDistance";
  static constexpr bool continuous = false;

  double alarmDistance = 1;
  double contactDistance = 0.5;
  bool filterIntersection = true;
  double angleCone = 0;
  double coneFactor = 0.5;
  bool useLMDFilters = false;

  static constexpr auto fields() {
    using L = LocalMinDistance;
    return proximity_fields<L>(
        field("filterIntersection", &L::filterIntersection, "", "only what is in the cones is a contact"),
        field("angleCone",
              &L::angleCone,
              "",
              "by how much more than their own width the cones are open, as the sine of an angle",
              range::nonNegative),
        field("coneFactor",
              &L::coneFactor,
              "",
              "how far the cones of convex edges and points reach, as a part of the angle (its sine) between "
              "what is beside them and their normal",
              range::nonNegative),
        field("useLMDFilters", &L::useLMDFilters, "", "cones are left to other components: no filter here"));
  }

  std::vector<SurfaceCones> cones{};  // of each surface

  double reach() const { return std::max(alarmDistance, contactDistance); }
  double limit() const { return contactDistance; }

  /// Of the models of the scene, in their order.
  void lookAround(std::span<CollisionSurface* const> surfaces) {
    cones.resize(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) cones[i].init(*surfaces[i], surfaces);
  }
  /// Neither lines nor triangles are nearest to triangles inside both.
  static bool compares(CollisionSurface const& a, CollisionSurface const& b) {
    return a.leastCorners() + b.leastCorners() <= 4;
  }

  template <Shape A, Shape B>
  std::optional<Contact> intersect(PrimitivePair<A, B> const& pair) const {
    if constexpr (corners_of(A) + corners_of(B) <= 4) {
      const auto a = pair.cornersA();
      const auto b = pair.cornersB();
      const auto closest = inner_closest_points(a, b);
      const double far = reach() + pair.proximity() + pair.thickness();
      if (!closest || closest->squaredDistance > far * far) return std::nullopt;
      const Eigen::Vector3d between = closest->pointB - closest->pointA;
      Contact contact = places_of(pair, *closest);
      if (!isLocalMinimum(pair.a, contact.a, between) || !isLocalMinimum(pair.b, contact.b, -between))
        return std::nullopt;
      set_normal(contact, pair, contact_direction(a, b, *closest));
      contact.limit = contactDistance + pair.proximity();
      return contact;
    }
    return std::nullopt;
  }

 private:
  bool isLocalMinimum(CollisionSurface const& s, ContactSide const& side, Eigen::Vector3d const& d) const {
    if (!filterIntersection || useLMDFilters) return true;
    if (s.shape == Shape::capsule) return s.isLocalMinimum(side.element, side.vertices, d, s.coneAlong);
    return cones[std::size_t(s.number)].hold(s, side.element, d, {angleCone, coneFactor});
  }
};

}  // namespace sinew
