// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/moved_primitive.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace sinew::detail {

/// A pair with a hull at a time after the step began. What no solver moves is at the end of its way then, and
/// comes from where it was a step before.
template <Shape A, Shape B>
struct MovedPair {
  using V = Eigen::Vector3d;
  MovedPrimitive<A> a;
  MovedPrimitive<B> b;
  V origin;  // of the views

  /// `swept`: whether they move at all; else they are where they are now.
  MovedPair(PrimitivePair<A, B> const& pair, bool swept, double time)
      : a(pair.a, pair.elementA, swept ? time - present(pair.a, pair.dt) : 0),
        b(pair.b, pair.elementB, swept ? time - present(pair.b, pair.dt) : 0),
        origin(A == Shape::hull ? a.corners[0] : b.corners[0]) {}

 private:
  // when, of the time since the step began, a surface is where it is
  static double present(CollisionSurface const& s, double dt) { return s.solver < 0 ? dt : 0; }
};

/// When the two come nearer than `limit` [s]: 0 where they are, -1 where they do not during this step.
template <Shape A, Shape B>
double time_of_hull_impact(PrimitivePair<A, B> const& pair, double limit) {
  double time = 0;
  const double near = limit + pair.thickness();
  for (int i = 0; i < 1000; ++i) {
    const MovedPair<A, B> at(pair, true, time);
    const ConvexContact c = convex_contact(at.a.view(at.origin), at.b.view(at.origin));
    const double gap = c.distance - near;
    if (gap <= 1e-3 * limit + 1e-9 * (at.a.size() + at.b.size())) return time;
    const double rate = at.a.fastestAlong(c.direction) + at.b.fastestAlong(-c.direction);
    if (!(rate * (pair.dt - time) > gap)) return -1;
    time += gap / rate;
  }
  return time;
}

/// The contact of the centres: `c` with all levers along the normal, and a margin for the rotation of the
/// hulls in the rest of the step. None where the centres do not come so near, or are slow.
template <Shape A, Shape B>
std::optional<Contact> contact_of_centres(PrimitivePair<A, B> const& pair, MovedPair<A, B> const& at,
                                          ConvexContact const& c, double time, double limit) {
  using V = Eigen::Vector3d;
  const V n = c.direction;
  double radius = std::numeric_limits<double>::infinity(), angularReach = 0;
  auto consider = [&](auto const& p) {
    if (p.surface.solver < 0 || !(p.size() > 0)) return;
    const double reach = p.reach();
    radius = std::min(radius, p.size());
    angularReach += std::min(1.0, p.surface.spin[p.vertex(0)].norm() * (pair.dt - time)) * reach;
  };
  consider(at.a), consider(at.b);
  const double approach = at.a.centreAlong(n) - at.b.centreAlong(n);
  if (!(approach * pair.dt > 0.2 * radius)) return std::nullopt;
  Contact contact;
  contact.normal = n;
  contact.thickness = pair.thickness();
  // where c is, n.p is that of the two, whatever the face
  place_side(contact.a, at.a, c.pointA + at.origin, Feature::whole(), n, contact.thickness);
  place_side(
      contact.b, at.b, V(c.pointA + c.distance * n + at.origin), Feature::whole(), -n, contact.thickness);
  auto toCentre = [&]<Shape S>(ContactSide& side, MovedPrimitive<S> const& p) {
    if constexpr (S == Shape::hull)
      if (p.surface.solver >= 0)
        side.lever =
            p.surface.orientation[p.vertex(0)].conjugate() * V(n.dot(p.orientation * side.lever) * n);
  };
  toCentre(contact.a, at.a), toCentre(contact.b, at.b);
  contact.limit = limit;
  const double gap =
      n.dot(position_of(contact.b, pair.b) - position_of(contact.a, pair.a)) - contact.thickness;
  const double room = std::clamp(gap - limit, 0.0, angularReach);
  contact.thickness += room;
  contact.distance = gap - room;
  if (!(contact.distance - approach * pair.dt < limit)) return std::nullopt;
  return contact;
}

}  // namespace sinew::detail
