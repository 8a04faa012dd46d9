// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/contact_manifold.hpp>
#include <sinew/collision/hull_impact.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew {

/// Contacts of hulls with hulls, segments and triangles, by their faces: where the two come nearest, or have
/// the least depth, the faces seen from there (up to 11 degrees from the plane across the normal) are cut
/// with one another; what a body stands on is up to 8 contacts with one normal, each with its own distance.
/// With points and spheres it is one contact. Contacts are known again by the corners and edges of the hull.
///
/// Triangles that go on flat into one another act as one face: their inner edges are not felt. A triangle of
/// a one-sided surface (bothSide = false) pushes to its outer side wherever the hull is inside it.
///
/// Under a continuous method, hulls that are not yet near advance by conservative advancement (Mirtich 1996):
/// with the distance d along n, and no point of either approaching faster than w = n.(v_a - v_b) + |w_a| r_a
/// + |w_b| r_b, they cannot meet before d / w; the contact is where they will first meet during the step.
/// What no solver moves comes from where it was a step before. A body that would hit askew and rotate over
/// the place that is stopped, and so pass by, is stopped as a whole: where the centres approach by more than
/// a fifth of the radius in a step, and would come nearer than at the impact, the contact keeps them from
/// that without a torque. In such a step angular momentum is not kept; the next ones, in which it is slow,
/// rotate it.
template <Shape A, Shape B>
struct HullContacts {
  using V = Eigen::Vector3d;

  template <class Intersection, class Add>
  static void find(PrimitivePair<A, B> const& pair, Intersection const& method, Add const& add) {
    static_assert(MeetsHulls<Intersection>,
                  "Sinew: an intersection method that meets hulls has limit(), the distance below which the "
                  "response acts.");
    const double limit = method.limit() + pair.proximity(), reach = method.reach() + pair.proximity();
    if constexpr (Intersection::continuous)
      if (const double time = detail::time_of_hull_impact(pair, limit); time >= 0) {
        contacts(pair, true, time, limit, time > 0 ? std::numeric_limits<double>::infinity() : reach, add);
        return;
      }
    contacts(pair, false, 0, limit, reach, add);
  }

 private:
  template <class Add>
  static void contacts(PrimitivePair<A, B> const& pair, bool swept, double time, double limit, double reach,
                       Add const& add) {
    const detail::MovedPair<A, B> at(pair, swept, time);
    V const& origin = at.origin;
    const detail::ConvexView viewA = at.a.view(origin), viewB = at.b.view(origin);
    // products of lengths are no numbers of what is too large
    if (!std::isfinite(viewA.radius * viewA.radius)) detail::refuse_place(pair.a, pair.elementA);
    if (!std::isfinite(viewB.radius * viewB.radius)) detail::refuse_place(pair.b, pair.elementB);
    ConvexContact c = detail::convex_contact(viewA, viewB);
    if (c.distance > reach + pair.thickness()) return;

    // the normal of a face of a surface, where the nearest place is inside it
    std::array<bool, 3> innerA{}, innerB{};
    bool ofFace = false;
    auto look =
        [&]<Shape S>(
            detail::MovedPrimitive<S> const& p, V const& place, double sign, std::array<bool, 3>& inner) {
          if constexpr (S == Shape::line || S == Shape::triangle) {
            const V away = sign * c.direction;
            const V w = detail::weights_at(p.corners, place + origin, Feature::face());
            ContactSide side;
            detail::set_side<S>(side, p.surface, p.element, w);
            if constexpr (S == Shape::triangle) {
              const detail::TriangleAround around(p.surface, p.element, p.corners, away);
              inner = around.inner;
              if (around.holds(w) && (c.distance <= 0 || w.minCoeff() <= 0 || !p.surface.settings.bothSide)) {
                ofFace = true;
                c.direction = sign * around.normal;
                c.distance = -detail::depth_along(viewA, viewB, c.direction);
                return true;
              }
            }
            return time > 0 || c.distance <= 0 || p.surface.isLocalMinimum(p.element, side.vertices, away);
          }
          return true;
        };
    if (!look(at.a, c.pointA, 1, innerA) || !look(at.b, c.pointB, -1, innerB)) return;
    const V n = c.direction;
    if (swept)
      if (auto whole = detail::contact_of_centres(pair, at, c, time, limit)) return void(add(*whole));

    // across n, along axes of the hull, so that it shows the same corners when it moves
    Eigen::Index axis = 0;
    const Eigen::Matrix3d rotation = A == Shape::hull ? viewA.rotation : viewB.rotation;
    for (Eigen::Index k = 1; k < 3; ++k)
      if (std::abs(rotation.col(k).dot(n)) < std::abs(rotation.col(axis).dot(n))) axis = k;
    const V s = n.cross(V(rotation.col(axis))).normalized(), t = n.cross(s);

    detail::Manifold manifold;
    auto single = [&] {
      const double along = n.dot(c.pointA);
      auto feature = [&](detail::ConvexView const& view, double side) {
        return detail::SupportPolygon(view, s, t, n, side).inside();
      };
      manifold.add({{s.dot(c.pointA), t.dot(c.pointA)},
                    along,
                    along + c.distance,
                    feature(viewA, 1),
                    feature(viewB, -1)},
                   -1);
    };
    if constexpr (A == Shape::point || B == Shape::point) {
      single();
    } else {
      detail::SupportPolygon faceA(viewA, s, t, n, 1), faceB(viewB, s, t, n, -1);
      mark(faceA, innerA);
      mark(faceB, innerB);
      double size = std::numeric_limits<double>::infinity();
      for (const double r : {viewA.radius, viewB.radius})
        if (r > 0) size = std::min(size, r);
      if (!(size < std::numeric_limits<double>::infinity())) size = 0;
      manifold.meet(faceA, faceB, 1e-3 * size, 1e-9 * size);
      manifold.reduce();
      if (!ofFace) {
        // nothing is nearer than the nearest, which is one of them
        double minimum = std::numeric_limits<double>::infinity();
        for (int i = 0; i < manifold.count; ++i) {
          auto& p = manifold.points[std::size_t(i)];
          p.heightB = std::max(p.heightB, p.heightA + c.distance);
          minimum = std::min(minimum, p.heightB - p.heightA);
        }
        if (!(minimum <= c.distance + 1e-3 * size)) single();
      }
    }

    for (int i = 0; i < manifold.count; ++i) {
      detail::ManifoldPoint const& p = manifold.points[std::size_t(i)];
      const V across = p.at[0] * s + p.at[1] * t + origin;
      Contact contact;
      contact.normal = n;
      contact.thickness = pair.thickness();
      detail::place_side(contact.a, at.a, across + p.heightA * n, p.featureA, n, contact.thickness);
      detail::place_side(contact.b, at.b, across + p.heightB * n, p.featureB, -n, contact.thickness);
      contact.limit = limit;
      contact.distance =
          n.dot(position_of(contact.b, pair.b) - position_of(contact.a, pair.a)) - contact.thickness;
      if (contact.distance <= reach) add(contact);
    }
  }

  // the edge behind corner c of a triangle is that from c to c + 1
  static void mark(detail::SupportPolygon& face, std::array<bool, 3> const& inner) {
    if (face.count != 3) return;
    if (!inner[0] && !inner[1] && !inner[2]) return;
    for (int k = 0; k < 3; ++k) {
      const int i = face.corner[std::size_t(k)], j = face.corner[std::size_t(face.next(k))];
      face.inner[std::size_t(k)] = inner[std::size_t((i + 1) % 3 == j ? i : j)];
    }
  }
};

}  // namespace sinew
