// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/topology/adjacency.hpp>

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sinew {

/// How wide cones are: a and k of SurfaceCones.
struct ConeWidth {
  double angle = 0, factor = 0.5;
};

/// The cones of the primitives of a surface: a place on one has what is nearest to it in its cone, unless a
/// neighbour is nearer (Duriez, Dubois, Kheddar, Andriot 2006; LocalMinDistance in SOFA). A direction d of
/// length 1 is in the cone
///   of a triangle with the normal n:                          n.d >= 0;
///   of an edge with the mean normal n of its two triangles, and the directions l in them, away from the edge
///   and from the triangle, across it:                         n.d >= 0,   l.d > -(k max(0, n.l) + a);
///   of a point with the mean normal n of its triangles, or, where it has none, of its edges, and the
///   directions l along its edges, away from them:             n.d >= -a,  l.d > -(k max(0, n.l) + a).
/// (By more than 1e-9, so that what lies in a plane with its neighbours has no direction, unless a > 0; faces
/// have what is there.) Models of which both sides are outside (bothSide) have no condition on n.d. Edges
/// with one triangle, or more than two, take every direction, and so do points where their body has no model
/// of lines.
class SurfaceCones {
 public:
  /// `all`: the models of the scene; those on the state of `s` are of its body.
  void init(CollisionSurface const& s, std::span<CollisionSurface* const> all);
  /// Whether d, from a place inside a primitive of that surface, is in the cone.
  bool hold(CollisionSurface const& s, int element, Eigen::Vector3d const& d, ConeWidth width) const;

 private:
  std::vector<Triangle> triangles_{};  // of the body
  Adjacency trianglesAround_{};  // of each vertex of a model of points, of each primitive of one of lines
  Adjacency joined_{};           // to each vertex, by edges

  bool ofPoint(CollisionSurface const& s, int vertex, Eigen::Vector3d const& d, ConeWidth width) const;
  bool ofLine(CollisionSurface const& s, int element, Eigen::Vector3d const& d, ConeWidth width) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Geometry>
#include <algorithm>

namespace sinew::detail {

inline Eigen::Vector3d unit_normal(CollisionSurface const& s, std::array<int, 3> const& corners) {
  auto const &p = s.position[std::size_t(corners[0])], &q = s.position[std::size_t(corners[1])],
             &r = s.position[std::size_t(corners[2])];
  return (q - p).cross(r - p).normalized();
}
// whether d does not lean from `away` towards what that leads away from
inline bool keeps_away(Eigen::Vector3d const& away, Eigen::Vector3d const& normal, Eigen::Vector3d const& d,
                       ConeWidth width) {
  const double sine = width.factor * std::max(0.0, normal.dot(away)) + width.angle;
  return away.dot(d) > (CollisionSurface::leastCone - sine) * d.norm();
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE void SurfaceCones::init(CollisionSurface const& s, std::span<CollisionSurface* const> all) {
  *this = {};
  if (s.shape != Shape::point && s.shape != Shape::line) return;
  std::vector<Edge> edges;
  for (auto const* other : all) {
    if (other->state != s.state) continue;
    for (auto const& e : other->elements)
      if (other->shape == Shape::triangle)
        triangles_.push_back(e);
      else if (other->shape == Shape::line)
        edges.push_back({std::min(e[0], e[1]), std::max(e[0], e[1])});
  }
  const std::size_t vertices = s.position.size();
  const Adjacency around = elements_around(triangles_, vertices);
  if (s.shape == Shape::point) {
    if (edges.empty()) return;
    trianglesAround_ = around;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    joined_ = neighbours(edges, vertices);
    return;
  }
  for (auto const& e : s.elements) {
    for (const Index t : around[std::size_t(e[0])])
      if (Triangle const& c = triangles_[std::size_t(t)]; std::find(c.begin(), c.end(), e[1]) != c.end())
        trianglesAround_.targets.push_back(t);
    trianglesAround_.offsets.push_back(trianglesAround_.targets.size());
  }
}

SINEW_ONCE bool SurfaceCones::hold(CollisionSurface const& s, int element, Eigen::Vector3d const& d,
                                   ConeWidth width) const {
  auto const& corners = s.elements[std::size_t(element)];
  switch (s.shape) {
    case Shape::point:
      return joined_.size() == 0 || ofPoint(s, corners[0], d, width);
    case Shape::line:
      return ofLine(s, element, d, width);
    case Shape::triangle:
      return s.settings.bothSide || detail::unit_normal(s, corners).dot(d) >= 0;
    default:
      return true;
  }
}

SINEW_ONCE bool SurfaceCones::ofPoint(CollisionSurface const& s, int vertex, Eigen::Vector3d const& d,
                                      ConeWidth width) const {
  const auto v = std::size_t(vertex);
  auto away = [&](Index other) -> Eigen::Vector3d {
    return (s.position[v] - s.position[std::size_t(other)]).normalized();
  };
  Eigen::Vector3d normal(0, 0, 0);
  for (const Index t : trianglesAround_[v]) normal += detail::unit_normal(s, triangles_[std::size_t(t)]);
  if (trianglesAround_[v].empty())
    for (const Index other : joined_[v]) normal += away(other);
  normal = normal.norm() > 1e-10 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d::Zero();
  if (!s.settings.bothSide && normal.dot(d) < -width.angle * d.norm()) return false;
  return std::all_of(joined_[v].begin(), joined_[v].end(), [&](Index other) {
    return detail::keeps_away(away(other), normal, d, width);
  });
}

SINEW_ONCE bool SurfaceCones::ofLine(CollisionSurface const& s, int element, Eigen::Vector3d const& d,
                                     ConeWidth width) const {
  const auto around = trianglesAround_[std::size_t(element)];
  if (around.size() != 2) return true;
  Triangle const &first = triangles_[std::size_t(around[0])], &second = triangles_[std::size_t(around[1])];
  const Eigen::Vector3d normal =
      (detail::unit_normal(s, first) + detail::unit_normal(s, second)).normalized();
  if (!s.settings.bothSide && normal.dot(d) < 0) return false;
  auto const& ends = s.elements[std::size_t(element)];
  const Eigen::Vector3d start = s.position[std::size_t(ends[0])],
                        along = (s.position[std::size_t(ends[1])] - start).normalized();
  auto keepsAwayFrom = [&](Triangle const& t) {
    const int corner = *std::find_if(t.begin(), t.end(), [&](int c) { return c != ends[0] && c != ends[1]; });
    const Eigen::Vector3d into = s.position[std::size_t(corner)] - start;
    return detail::keeps_away((along.dot(into) * along - into).normalized(), normal, d, width);
  };
  return keepsAwayFrom(first) && keepsAwayFrom(second);
}

}  // namespace sinew
#endif
