// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/convex.hpp>
#include <sinew/collision/proximity.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace sinew::detail {

/// A primitive where it will be after `time` at the velocity it has; before, where it is less than 0.
template <Shape S>
struct MovedPrimitive {
  static constexpr bool isHull = S == Shape::hull;
  using V = Eigen::Vector3d;
  CollisionSurface const& surface;
  int element;
  std::array<V, std::size_t(isHull ? 1 : corners_of(S))> corners;  // of a hull its centre
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  MovedPrimitive(CollisionSurface const& s, int e, double time) : surface(s), element(e) {
    for (std::size_t c = 0; c < corners.size(); ++c)
      corners[c] = s.position[vertex(c)] + time * s.velocity[vertex(c)];
    if constexpr (isHull) {
      orientation = s.orientation[vertex(0)];
      const V rotation = time * s.spin[vertex(0)];
      if (const double angle = rotation.norm(); angle > 0)
        orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, V(rotation / angle))) * orientation;
    }
  }
  std::size_t vertex(std::size_t c) const { return std::size_t(surface.elements[std::size_t(element)][c]); }
  double size() const { return isHull ? surface.hullOf(element).radius() + surface.radiusOf(element) : 0; }
  /// No point is farther from the centre [m].
  double reach() const { return surface.hullOf(element).reach() + surface.radiusOf(element); }
  ConvexView view(V const& origin) const {
    if constexpr (isHull)
      return convex_view(PosedHull{surface.hullOf(element), {corners[0], orientation}}, origin);
    else
      return convex_view(corners, origin);
  }
  double centreAlong(V const& n) const {
    double maximum = -std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < corners.size(); ++c)
      maximum = std::max(maximum, n.dot(surface.velocity[vertex(c)]));
    return maximum;
  }
  /// No point goes faster along n [m/s].
  double fastestAlong(V const& n) const {
    double maximum = centreAlong(n);
    if constexpr (isHull) maximum += surface.spin[vertex(0)].norm() * reach();
    return maximum;
  }
};

/// Weights of the corners of a simplex at a place near its corner, edge or face.
template <std::size_t N>
Eigen::Vector3d weights_at(std::array<Eigen::Vector3d, N> const& p, Eigen::Vector3d const& x,
                           Feature const& feature) {
  Eigen::Vector3d w(0, 0, 0);
  if (feature.kind() == Feature::Kind::vertex) {
    w[feature.first] = 1;
  } else if (feature.kind() == Feature::Kind::edge) {
    const auto i = std::size_t(feature.first), j = std::size_t(feature.second);
    const Eigen::Vector3d u = p[j] - p[i];
    w[feature.second] = std::clamp(u.dot(x - p[i]) / u.squaredNorm(), 0.0, 1.0);
    w[feature.first] = 1 - w[feature.second];
  } else {
    w = SimplexFrame<double, N>(p).nearest(x - p[0]);
  }
  // an edge between two triangles is the same edge for both
  for (int c = 0; c < 3; ++c)
    if (w[c] < 1e-9) w[c] = 0;
  return w / w.sum();
}

/// Of a triangle: its normal, and the edges behind which the surface goes on flat, or rises on the side that
/// `towards` points to.
struct TriangleAround {
  Eigen::Vector3d normal{0, 0, 0};  // towards the one that it meets, of length 1; 0 where it has no area
  double side = 1;                  // that is, this times the normal of the corners in their order
  std::array<bool, 3> inner{false, false, false};

  TriangleAround(CollisionSurface const& s, int element, std::array<Eigen::Vector3d, 3> const& p,
                 Eigen::Vector3d const& towards) {
    const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    const double length = n.norm();
    if (!(length > 0)) return;
    side = n.dot(towards) >= 0 || !s.settings.bothSide ? 1 : -1;
    normal = side / length * n;
    for (std::size_t c = 0; c < 3 && !s.across.empty(); ++c) {
      const int other = s.across[std::size_t(element)][c];
      if (other < 0) continue;
      const auto e = s.elements[std::size_t(element)];
      const Eigen::Vector3d start = s.position[std::size_t(e[c])],
                            along = s.position[std::size_t(e[(c + 1) % 3])] - start;
      Eigen::Vector3d direction = s.position[std::size_t(other)] - start;
      direction -= direction.dot(along) / std::max(along.squaredNorm(), 1e-300) * along;
      inner[c] = direction.dot(normal) >= -0.02 * direction.norm();
    }
  }
  /// Whether a place with these weights is inside the surface, not at a border or a ridge.
  bool holds(Eigen::Vector3d const& w) const {
    if (!(normal.squaredNorm() > 0)) return false;
    for (Eigen::Index c = 0; c < 3; ++c)  // the edge behind corner c is away from corner c + 2
      if (w[(c + 2) % 3] <= 0 && !inner[std::size_t(c)]) return false;
    return true;
  }
};

/// A place on a primitive as a side of a contact; what touches a sphere or a hull with a radius does so on
/// the skin of the rigid, and the thickness of the contact is without its radius.
template <Shape S>
void place_side(ContactSide& side, MovedPrimitive<S> const& p, Eigen::Vector3d const& at,
                Feature const& feature, Eigen::Vector3d const& outwards, double& thickness) {
  if constexpr (S == Shape::hull) {
    side.element = p.element;
    side.vertices = {int(p.vertex(0)), -1, -1};
    side.weights = {1, 0, 0};
    const double radius = p.surface.radiusOf(p.element);
    side.lever = p.orientation.conjugate() * (at + radius * outwards - p.corners[0]);
    side.feature = feature;
    thickness -= radius;
  } else {
    set_side<S>(side, p.surface, p.element, weights_at(p.corners, at, feature));
    if (!p.surface.rigid) return;
    const double radius = p.surface.radiusOf(p.element);
    side.lever = p.surface.orientation[p.vertex(0)].conjugate() * (radius * outwards);
    thickness -= radius;
  }
}

}  // namespace sinew::detail
