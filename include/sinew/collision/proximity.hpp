// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/closest_points.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/core/roles/intersection.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace sinew {

/// The corners of a primitive of a shape.
template <Shape S>
using ShapeCorners = std::array<Eigen::Vector3d, std::size_t(corners_of(S))>;

/// Two primitives of two surfaces, seen by an intersection method: their corners, and the motion of these
/// during the step. Spheres are points here; radiusOf() of their surfaces is around them. Surfaces are those
/// of models, or what has the same names of members in memory of a GPU.
template <Shape A, Shape B, class SurfaceA, class SurfaceB>
struct PrimitivePair {
  SurfaceA const& a;
  SurfaceB const& b;
  int elementA, elementB;
  double dt;
  double cone = CollisionSurface::leastCone;  // for isLocalMinimum
  int firstA = 0, firstB = 0;                 // the first of their corners: that of an end of a capsule

  SINEW_HD auto cornersA() const { return corners<A>(a, elementA, firstA); }
  SINEW_HD auto cornersB() const { return corners<B>(b, elementB, firstB); }
  SINEW_HD double thickness() const { return a.radiusOf(elementA) + b.radiusOf(elementB); }
  SINEW_HD double proximity() const { return a.settings.proximity + b.settings.proximity; }

 private:
  template <Shape S, class Surface>
  SINEW_HD static auto corners(Surface const& s, int element, [[maybe_unused]] int first) {
    constexpr auto n = std::size_t(corners_of(S));
    if constexpr (S == Shape::point && std::is_same_v<Surface, CollisionSurface>)
      return std::array<Eigen::Vector3d, 1>{
          s.position[std::size_t(s.elements[std::size_t(element)][std::size_t(first)])]};
    else
      return s.template corner<n>(s.position, element);
  }
};

namespace detail {

[[noreturn]] inline void refuse_place(CollisionSurface const& s, int element) {
  throw Error(
      s.path,
      text("places on element ",
           element,
           " of its collision model are not finite numbers: it is too large, or too far away; correct its "
           "points, or scale the scene"));
}

// where no corner has a weight, which is so for numbers that are not finite, there is no vertex on a GPU
SINEW_ANY_SIDE
template <Shape S, class Surface>
SINEW_HD void set_side(ContactSide& side, Surface const& s, int element, Eigen::Vector3d const& weights,
                       int first = 0) {
  side.element = element;
  int n = 0;
  for (std::size_t c = 0; c < std::size_t(corners_of(S)); ++c)
    if (weights[Eigen::Index(c)] > 0) {
      side.vertices[std::size_t(n)] = s.elements[std::size_t(element)][std::size_t(first) + c];
      side.weights[std::size_t(n++)] = weights[Eigen::Index(c)];
    }
  if constexpr (std::is_same_v<Surface, CollisionSurface>)
    if (n == 0) refuse_place(s, element);
}

// the outer normal of a triangle whose inside is meant by the point, or whose border where what is between it
// and the other place stands upright on it, as on the edges inside a plane; zero where it is not
template <class Surface, std::size_t N>
SINEW_HD Eigen::Vector3d outer_normal(Surface const& s, std::array<Eigen::Vector3d, N> const& p,
                                      Eigen::Vector3d const& weights, Eigen::Vector3d const& between) {
  if constexpr (N == 3)
    if (!s.settings.bothSide) {
      const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
      const double length = n.norm();
      if (length > 0 && (weights.minCoeff() > 0 || n.cross(between).norm() <= 1e-9 * length * between.norm()))
        return n / length;
    }
  return {0, 0, 0};
}

// Whether no neighbour is nearer to the other primitive in the direction d. What lies along a capsule,
// nearly, meets both of its ends, and a face both, however askew it stands.
SINEW_ANY_SIDE
template <Shape S, class Surface, std::size_t N>
SINEW_HD bool is_nearest(Surface const& s, int element, std::array<int, 3> const& vertices,
                         Eigen::Vector3d const& d,
                         [[maybe_unused]] std::array<Eigen::Vector3d, N> const& other, double cone) {
  if constexpr (S == Shape::point && std::is_same_v<Surface, CollisionSurface>)
    if (s.shape == Shape::capsule) {
      cone = CollisionSurface::coneAlong;
      if constexpr (N == 3) {
        const Eigen::Vector3d n = (other[1] - other[0]).cross(other[2] - other[0]);
        if (n.cross(d).norm() <= 1e-9 * n.norm() * d.norm()) return true;
      }
    }
  return s.isLocalMinimum(element, vertices, d, cone);
}

}  // namespace detail

/// Two bodies may have several models each, and what touches is then found by several pairs of them. One pair
/// has it: that of the smallest primitives on which its two places are; where both have points, lines and
/// triangles, points against triangles and lines against lines.
template <Shape A, Shape B, class SA, class SB>
SINEW_HD bool is_of_pair(PrimitivePair<A, B, SA, SB> const& pair, Contact const& contact) {
  const int ofA = contact.a.corners(), ofB = contact.b.corners();
  if (pair.a.hasAllSimplices() && pair.b.hasAllSimplices())
    return A == Shape::point || (ofA >= 2 && (B == Shape::point || ofB == 2));
  return pair.a.smallestAround(ofA) == A && pair.b.smallestAround(ofB) == B;
}

/// Whether two models have contacts that those beside them on their states do not have: of bodies with
/// points, lines and triangles, points with triangles and lines with lines have all.
inline bool has_pairs(CollisionSurface const& a, CollisionSurface const& b) {
  return !a.hasAllSimplices() || !b.hasAllSimplices() || a.corners() + b.corners() == 4;
}

/// The fields of an intersection method that looks for what is near, and more.
template <class I, class... More>
constexpr auto proximity_fields(More... more) {
  return field_list(field("alarmDistance",
                          &I::alarmDistance,
                          "m",
                          "contacts are looked for up to this distance",
                          range::nonNegative),
                    field("contactDistance",
                          &I::contactDistance,
                          "m",
                          "distance below which the response acts",
                          range::nonNegative),
                    more...);
}

/// Finds the contacts of pairs with a hull: find(pair, intersection method, add). Declared here only:
/// hull_contacts.hpp, which needs libccd, defines it for who has hulls.
template <Shape A, Shape B>
struct HullContacts;

/// Whether two primitives are farther from each other than `reach`, as planes across a few directions show:
/// the line between their middles, the normals of triangles, and what is across both of two segments. Most
/// that are near by their boxes only are told apart so, at a tenth of the cost of closest points; what is
/// not may be far as well.
template <std::size_t NA, std::size_t NB>
SINEW_HD bool are_apart(std::array<Eigen::Vector3d, NA> const& a, std::array<Eigen::Vector3d, NB> const& b,
                        double reach) {
  const double square = reach * reach * (1 + 1e-9);  // rounding does not part what is near
  auto parted = [&](Eigen::Vector3d const& n) {
    double lowA = 0, highA = 0, lowB = (b[0] - a[0]).dot(n), highB = lowB;
    for (std::size_t i = 1; i < NA; ++i) {
      const double h = (a[i] - a[0]).dot(n);
      lowA = std::min(lowA, h), highA = std::max(highA, h);
    }
    for (std::size_t j = 1; j < NB; ++j) {
      const double h = (b[j] - a[0]).dot(n);
      lowB = std::min(lowB, h), highB = std::max(highB, h);
    }
    const double gap = std::max(lowB - highA, lowA - highB);
    return gap > 0 && gap * gap > square * n.squaredNorm();
  };
  auto normal = [](auto const& p) -> Eigen::Vector3d { return (p[1] - p[0]).cross(p[2] - p[0]); };
  if constexpr (NB == 3)
    if (parted(normal(b))) return true;
  if constexpr (NA == 3)
    if (parted(normal(a))) return true;
  if constexpr (NA == 2 && NB == 2)
    if (parted((a[1] - a[0]).cross(b[1] - b[0]))) return true;
  Eigen::Vector3d between(0, 0, 0);
  for (auto const& x : a) between -= (x - a[0]) / double(NA);
  for (auto const& x : b) between += (x - a[0]) / double(NB);
  return parted(between);
}

/// A contact at closest points of two primitives: its places, and u there.
template <Shape A, Shape B, class SA, class SB>
SINEW_HD Contact places_of(PrimitivePair<A, B, SA, SB> const& pair, ClosestPoints<double> const& closest) {
  Contact contact;
  contact.start = closest.pointB - closest.pointA;
  detail::set_side<A>(contact.a, pair.a, pair.elementA, closest.weightsA, pair.firstA);
  detail::set_side<B>(contact.b, pair.b, pair.elementB, closest.weightsB, pair.firstB);
  return contact;
}
/// Its normal, and with that the distance between surfaces: what touches a sphere or a thick rigid does so on
/// its skin.
template <Shape A, Shape B, class SA, class SB>
SINEW_HD void set_normal(Contact& contact, PrimitivePair<A, B, SA, SB> const& pair,
                         Eigen::Vector3d const& normal) {
  contact.normal = normal;
  contact.thickness = pair.thickness();
  contact.distance = normal.dot(contact.start) - contact.thickness;
  auto toSkin = [&](ContactSide& side, auto const& s, double along) {
    if (s.rigid) side.lever = s.orientation[std::size_t(side.vertices[0])].conjugate() * (along * normal);
  };
  toSkin(contact.a, pair.a, pair.a.radiusOf(pair.elementA));
  toSkin(contact.b, pair.b, -pair.b.radiusOf(pair.elementB));
  if (pair.a.rigid) contact.thickness -= pair.a.radiusOf(pair.elementA);
  if (pair.b.rigid) contact.thickness -= pair.b.radiusOf(pair.elementB);
}

/// The contact of two primitives at their closest points, the corners being at `a` and `b`; false where a
/// neighbour of one of them is nearer there, unless that is not asked (`onlyLocalMinima`). Where a corner or
/// the inside of an edge is nearest to the inside of a triangle of a one-sided surface (bothSide = false), or
/// to an edge or a corner of it in a plane, the normal is that of the triangle, and the distance is negative
/// behind it.
SINEW_ANY_SIDE
template <Shape A, Shape B, class SA, class SB>
SINEW_HD bool find_contact(PrimitivePair<A, B, SA, SB> const& pair, ShapeCorners<A> const& a,
                           ShapeCorners<B> const& b, bool onlyLocalMinima, Contact& contact) {
  const auto closest = closest_points(a, b);
  contact = places_of(pair, closest);
  const Eigen::Vector3d between = contact.start;
  // a point has one nearest place, and would be stopped by the edges inside a floor that it slides on
  constexpr bool ofPoint = std::tuple_size_v<ShapeCorners<A>> == 1 || std::tuple_size_v<ShapeCorners<B>> == 1;
  const double cone = ofPoint ? CollisionSurface::leastCone : pair.cone;
  if (onlyLocalMinima &&
      (!detail::is_nearest<A>(pair.a, pair.elementA, contact.a.vertices, between, b, cone) ||
       !detail::is_nearest<B>(pair.b, pair.elementB, contact.b.vertices, -between, a, cone)))
    return false;
  const Eigen::Vector3d outOfA = detail::outer_normal(pair.a, a, closest.weightsA, between),
                        outOfB = detail::outer_normal(pair.b, b, closest.weightsB, between);
  // where an edge crosses a triangle, that is the face
  const bool insideA = A == Shape::triangle && closest.weightsA.minCoeff() > 0,
             insideB = B == Shape::triangle && closest.weightsB.minCoeff() > 0;
  const bool faceA = outOfA.squaredNorm() > 0 && insideA >= insideB,
             faceB = outOfB.squaredNorm() > 0 && insideB >= insideA;
  set_normal(contact,
             pair,
             faceA == faceB ? Eigen::Vector3d(contact_direction(a, b, closest))
             : faceA        ? outOfA
                            : Eigen::Vector3d(-outOfB));
  return true;
}
/// The same as an optional, which nvcc has on the host only.
template <Shape A, Shape B>
std::optional<Contact> contact_at(PrimitivePair<A, B> const& pair, ShapeCorners<A> const& a,
                                  ShapeCorners<B> const& b, bool onlyLocalMinima = true) {
  std::optional<Contact> found(std::in_place);
  if (!find_contact(pair, a, b, onlyLocalMinima, *found)) found.reset();
  return found;
}

}  // namespace sinew
