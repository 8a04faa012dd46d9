// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/blade.hpp>

#include <span>
#include <vector>

namespace sinew {

/// The blade that cuts triangles along a path: it goes through them along their normals, half of the longest
/// side of the nearest triangle to both sides of it. Triangles are at x; `places` are where the points are of
/// the surface on which the path lies: x, or the rest positions, from which the path follows the surface.
/// Throws Error where a point of the path is farther from the surface than that.
Blade incision_blade(std::vector<Eigen::Vector3d> const& path, std::span<Triangle const> triangles,
                     std::vector<Eigen::Vector3d> const& x, std::vector<Eigen::Vector3d> const& places);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/point_location.hpp>

#include <algorithm>

namespace sinew {

SINEW_ONCE Blade incision_blade(std::vector<Eigen::Vector3d> const& path, std::span<Triangle const> triangles,
                                std::vector<Eigen::Vector3d> const& x,
                                std::vector<Eigen::Vector3d> const& places) {
  const ElementLocator<TriangleFit> surface(places, triangles);
  Blade blade;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (Eigen::Vector3d const& p : path) {
    const auto located = surface.locate(p);
    if (located.element < 0) throw Error({}, "there is no triangle to cut; give the topology some");
    Triangle const& t = triangles[std::size_t(located.element)];
    Eigen::Vector3d corner[3], place = Eigen::Vector3d::Zero();
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = x[std::size_t(t[k])];
      place += located.fit.weights[Eigen::Index(k)] * corner[k];
    }
    for (std::size_t k = 0; k < 3; ++k) reach = std::max(reach, (corner[(k + 1) % 3] - corner[k]).norm() / 2);
    if (!(-located.fit.score <= reach))
      throw Error({},
                  text("the incision passes (",
                       p[0],
                       ", ",
                       p[1],
                       ", ",
                       p[2],
                       "), ",
                       -located.fit.score,
                       " m from the surface; give places on it"));
    Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    if (normal.dot(last) < 0) normal = -normal;
    last = normal;
    blade.from.push_back(place - reach * normal);
    blade.to.push_back(place + reach * normal);
  }
  return blade;
}

}  // namespace sinew
#endif
