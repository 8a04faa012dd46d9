// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/collision/ray_hits.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Contacts of closed surfaces of triangles that are in each other, by rays (Hermann, Faure, Raffin 2008):
/// from each vertex of the one a ray goes inwards, along its normal. Where it leaves the other body before
/// its own, the vertex is in the other body, as deep as the ray is long, and the contact is between it and
/// the place where the ray goes out, along the ray. A vertex normal is that of the triangles around it,
/// weighted by their areas. Contacts are there for bodies that overlap, however deep, and for no others: a
/// response that acts from a contact distance on, as that of the intersection method, begins with its force
/// at no gap, so that this distance should be short.
///
/// A body that is wholly inside another has no contacts. A surface without an inside, such as a floor of one
/// layer, stops the vertices of closed ones, but its own vertices find nothing. Of a surface in two layers,
/// as some files of meshes have it, the vertices of both find their contacts. Rays are followed in the
/// hierarchies of boxes that BVHNarrowPhase has, too; SOFA has octrees. All other pairs of models (spheres,
/// hulls, a body with itself) are as with BVHNarrowPhase; points and lines beside triangles are left to
/// these.
struct RayTraceNarrowPhase {
  using Role = role::NarrowPhase;
  static constexpr std::string_view className = "RayTraceNarrowPhase";

  static constexpr auto fields() { return field_list(); }

  std::vector<Eigen::Vector3d> normals{};  // of the vertices whose rays are followed

  /// Room for the normals of the largest model.
  void lookAround(std::span<CollisionSurface* const> surfaces);

  /// Whether the contacts of two models are found here, by contacts().
  static bool meets(CollisionSurface const& a, CollisionSurface const& b) {
    return a.state != b.state && hasTriangles(a) && hasTriangles(b);
  }
  /// f(contact) for all that two models have, with a and b on their sides; `limit`: below which the response
  /// acts.
  template <class F>
  void contacts(CollisionSurface const& a, CollisionSurface const& b, double limit, F&& f) {
    if (a.shape != Shape::triangle || b.shape != Shape::triangle) return;
    Contact contact;
    contact.limit = limit;
    setNormals(a);
    forEachVertex(a, [&](int v, int e) {
      if (!trace(a, v, e, b, contact.a, contact.b)) return;
      contact.normal = normals[std::size_t(v)];
      put(contact, a, b, f);
    });
    setNormals(b);
    forEachVertex(b, [&](int v, int e) {
      if (!trace(b, v, e, a, contact.b, contact.a)) return;
      contact.normal = -normals[std::size_t(v)];
      put(contact, a, b, f);
    });
  }
  template <class F>
  void pairs(CollisionSurface const& a, CollisionSurface const& b, F&& f) {
    if (&a == &b)
      a.tree.self_pairs(0, f);
    else
      a.tree.pairs(b.tree, 0, f);
  }

 private:
  static bool hasTriangles(CollisionSurface const& s) {
    return s.shape == Shape::triangle || (is_simplex(s.shape) && s.companions.has(Shape::triangle));
  }
  template <class F>
  static void put(Contact& contact, CollisionSurface const& a, CollisionSurface const& b, F&& f) {
    contact.distance = contact.normal.dot(position_of(contact.b, b) - position_of(contact.a, a));
    Contact found = contact;
    f(found);
  }
  // f(vertex, the first triangle that has it)
  template <class F>
  void forEachVertex(CollisionSurface const& s, F&& f) const {
    for (std::size_t e = 0; e < s.size(); ++e)
      for (const int v : s.elements[e])
        if (firstElement[std::size_t(v)] == int(e)) f(v, int(e));
  }

  std::vector<int> firstElement{};

  void setNormals(CollisionSurface const& s);
  // whether the ray of a vertex leaves the other body before its own: the sides of the two
  bool trace(CollisionSurface const& own, int vertex, int element, CollisionSurface const& other,
             ContactSide& mine, ContactSide& its) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <limits>

namespace sinew {
namespace detail {

// The first triangle that a ray meets; -1: there is none. A ray that begins on the surface leaves out what
// has a corner there: triangles of its vertex, and of another one at the same place, as of a surface in two
// layers.
inline std::pair<int, RayHit> first_hit(Ray const& ray, CollisionSurface const& s, bool beginsThere) {
  std::pair<int, RayHit> best{-1, {}};
  s.tree.ray(ray.origin, ray.direction, std::numeric_limits<double>::infinity(), [&](int e, double until) {
    const auto p = s.corner<3>(s.position, e);
    if (beginsThere && std::find(p.begin(), p.end(), ray.origin) != p.end()) return until;
    const RayHit hit = ray_triangle(ray, p, s.elements[std::size_t(e)]);
    if (!hit || !(hit.distance <= until)) return until;
    if (hit.distance < best.second.distance || e < best.first) best = {e, hit};
    return hit.distance;
  });
  return best;
}
// Whether a ray goes through a triangle from its inside.
inline bool goes_out(Ray const& ray, CollisionSurface const& s, int element) {
  const auto p = s.corner<3>(s.position, element);
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(ray.direction) > 0;
}

}  // namespace detail

SINEW_ONCE void RayTraceNarrowPhase::lookAround(std::span<CollisionSurface* const> surfaces) {
  std::size_t most = 0;
  for (auto const* s : surfaces) most = std::max(most, s->position.size());
  normals.reserve(most);
  firstElement.reserve(most);
}

SINEW_ONCE void RayTraceNarrowPhase::setNormals(CollisionSurface const& s) {
  normals.assign(s.position.size(), Eigen::Vector3d::Zero());
  firstElement.assign(s.position.size(), -1);
  for (std::size_t e = 0; e < s.size(); ++e) {
    const auto p = s.corner<3>(s.position, int(e));
    const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    for (const int v : s.elements[e]) {
      normals[std::size_t(v)] += n;
      if (firstElement[std::size_t(v)] < 0) firstElement[std::size_t(v)] = int(e);
    }
  }
  for (auto& n : normals)
    if (const double length = n.norm(); length > 0) n /= length;
}

SINEW_ONCE bool RayTraceNarrowPhase::trace(CollisionSurface const& own, int vertex, int element,
                                           CollisionSurface const& other, ContactSide& mine,
                                           ContactSide& its) const {
  Eigen::Vector3d const& normal = normals[std::size_t(vertex)];
  if (!(normal.squaredNorm() > 0)) return false;
  const Ray ray{own.position[std::size_t(vertex)], -normal};
  const auto [e, hit] = detail::first_hit(ray, other, false);
  if (e < 0 || !detail::goes_out(ray, other, e)) return false;
  const auto [wall, through] = detail::first_hit(ray, own, true);
  if (wall < 0 || !detail::goes_out(ray, own, wall) || through.distance < hit.distance) return false;
  mine.element = element;
  mine.vertices = {vertex, -1, -1};
  mine.weights = {1, 0, 0};
  its.element = e;
  its.vertices = {-1, -1, -1};
  its.weights = {0, 0, 0};
  std::size_t n = 0;
  for (std::size_t c = 0; c < 3; ++c)
    if (hit.weights[c] > 0) {
      its.vertices[n] = other.elements[std::size_t(e)][c];
      its.weights[n++] = hit.weights[c];
    }
  return n > 0;
}

}  // namespace sinew
#endif
