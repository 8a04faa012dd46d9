// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/proximity.hpp>
#include <sinew/core/compiled.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Whether a place is in a tetrahedron, or on it: it is on the same side of all faces as the corner opposite.
/// Nothing is in one that has no volume.
bool is_inside(std::array<Eigen::Vector3d, 4> const& tetrahedron, Eigen::Vector3d const& x);

/// The contacts of points and spheres whose centres are in a surface that is filled
/// (CollisionSurface::solid), however deep, with the nearest place on it: pushed out along the line to that.
/// Into `found`, the filled surface on the side a, or b where it is not `first`.
void find_in_solid(CollisionSurface const& solid, CollisionSurface const& points, double limit, bool first,
                   std::vector<Contact>& found);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <limits>

namespace sinew {

SINEW_ONCE bool is_inside(std::array<Eigen::Vector3d, 4> const& t, Eigen::Vector3d const& x) {
  auto volume = [](Eigen::Vector3d const& a,
                   Eigen::Vector3d const& b,
                   Eigen::Vector3d const& c,
                   Eigen::Vector3d const& d) { return (b - a).cross(c - a).dot(d - a); };
  const double whole = volume(t[0], t[1], t[2], t[3]);
  const std::array<double, 4> parts{volume(x, t[1], t[2], t[3]),
                                    volume(t[0], x, t[2], t[3]),
                                    volume(t[0], t[1], x, t[3]),
                                    volume(t[0], t[1], t[2], x)};
  return whole != 0 && std::all_of(parts.begin(), parts.end(), [&](double p) { return p * whole >= 0; });
}

SINEW_ONCE void find_in_solid(CollisionSurface const& solid, CollisionSurface const& points, double limit,
                              bool first, std::vector<Contact>& found) {
  solid.solidTree.pairs(points.tree, 0, [&](int tetrahedron, int element) {
    const Eigen::Vector3d x = points.corner<1>(points.position, element)[0];
    std::array<Eigen::Vector3d, 4> corners;
    for (std::size_t c = 0; c < 4; ++c)
      corners[c] = solid.position[std::size_t(solid.solid[std::size_t(tetrahedron)][c])];
    if (!is_inside(corners, x)) return;
    AxisBox at;
    at.include(x);
    const auto nearest = solid.tree.nearest(at, std::numeric_limits<double>::infinity(), [&](int triangle) {
      return std::sqrt(
          closest_points(solid.corner<3>(solid.position, triangle), std::array{x}).squaredDistance);
    });
    if (nearest.index < 0) return;
    // out of the solid; along the normal where the place is on a face, which is right at no depth, too
    const PrimitivePair<Shape::triangle, Shape::point> pair{solid, points, nearest.index, element, 0};
    const auto p = pair.cornersA();
    const auto closest = closest_points(p, pair.cornersB());
    Contact contact = places_of(pair, closest);
    Eigen::Vector3d out = (p[1] - p[0]).cross(p[2] - p[0]);
    if (closest.weightsA.minCoeff() <= 0 && contact.start.squaredNorm() > 0) out = -contact.start;
    const double length = out.norm();
    if (!(length > 0)) return;
    set_normal(contact, pair, out / length);
    contact.limit = limit;
    if (!first) {
      std::swap(contact.a, contact.b);
      contact.normal = -contact.normal;
      contact.start = -contact.start;
    }
    found.push_back(contact);
  });
}

}  // namespace sinew
#endif
