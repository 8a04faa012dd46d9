// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace sinew {

/// How good the tetrahedra of a mesh are. Angles in degrees, volumes in the cubed unit of the positions.
/// A regular tetrahedron has dihedral angles of 70.53 degrees. minVolume < 0 tells of an inverted
/// tetrahedron.
struct TetrahedronQuality {
  double minDihedral = 180, maxDihedral = 0;
  double minVolume = std::numeric_limits<double>::infinity(), volume = 0;
};

/// How good a triangulated surface is. Angles in degrees; area and enclosed volume in units of the positions.
struct SurfaceQuality {
  double minAngle = 180, maxAngle = 0;
  double area = 0;
  double volume = 0;            // enclosed; positive where the triangles turn their front outwards
  int eulerCharacteristic = 0;  // points - edges + triangles: 2 for a sphere, 0 for a torus
  bool closed = false;          // every edge has two triangles, which pass it in opposite directions
  bool manifold = false;        // closed, and the triangles around each point form a single ring
};

/// Signed volume of the tetrahedron, det(x1 - x0, x2 - x0, x3 - x0) / 6.
inline double tetrahedron_volume(Eigen::Vector3d const& x0, Eigen::Vector3d const& x1,
                                 Eigen::Vector3d const& x2, Eigen::Vector3d const& x3) {
  return (x1 - x0).dot((x2 - x0).cross(x3 - x0)) / 6;
}

/// Extreme dihedral angles, smallest and total volume of the tetrahedra of a mesh.
/// Throws Error when there are none, or when one refers to a point that is missing.
TetrahedronQuality quality(Mesh const& mesh);

/// Extreme angles, area, enclosed volume and topology of the triangles of a mesh. Points that no triangle
/// uses do not count. Throws Error when there are no triangles, or when one refers to a point that is
/// missing.
SurfaceQuality surface_quality(Mesh const& mesh);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>
#include <sinew/topology/adjacency.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::detail {

/// Whether the triangles of a closed surface form one ring around each point.
inline bool has_single_rings(std::vector<Triangle> const& triangles, std::size_t points) {
  const Adjacency around = elements_around(triangles, points);
  for (std::size_t i = 0; i < points; ++i) {
    auto follow = [&](Index from) {  // triangle (i, from, to)
      for (const Index e : around[i]) {
        Triangle const& t = triangles[std::size_t(e)];
        for (std::size_t c = 0; c < 3; ++c)
          if (t[c] == Index(i) && t[(c + 1) % 3] == from) return t[(c + 2) % 3];
      }
      return Index(-1);
    };
    if (around[i].empty()) continue;
    Triangle const& first = triangles[std::size_t(around[i].front())];
    const Index start = first[0] == Index(i) ? first[1] : first[1] == Index(i) ? first[2] : first[0];
    std::size_t length = 0;
    for (Index j = start; length <= around[i].size() && (length == 0 || j != start); ++length) j = follow(j);
    if (length != around[i].size()) return false;
  }
  return true;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE TetrahedronQuality quality(Mesh const& mesh) {
  if (mesh.tetrahedra.empty()) throw Error("quality", "the mesh has no tetrahedra; give a volume mesh");
  check_mesh("quality", mesh);
  constexpr int edges[6][4] = {
      {0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  TetrahedronQuality result;
  for (Tetrahedron const& t : mesh.tetrahedra) {
    const Eigen::Vector3d x[4] = {mesh.positions[std::size_t(t[0])],
                                  mesh.positions[std::size_t(t[1])],
                                  mesh.positions[std::size_t(t[2])],
                                  mesh.positions[std::size_t(t[3])]};
    const double volume = tetrahedron_volume(x[0], x[1], x[2], x[3]);
    result.minVolume = std::min(result.minVolume, volume);
    result.volume += volume;
    // angle between the faces (i, j, k) and (i, j, l):  n = e x a,  m = e x b,  n x m = e (e . (a x b))
    for (auto const& [i, j, k, l] : edges) {
      const Eigen::Vector3d e = x[j] - x[i], n = e.cross(x[k] - x[i]), m = e.cross(x[l] - x[i]);
      const double angle = std::atan2(e.norm() * std::abs(6 * volume), n.dot(m)) * 180 / std::numbers::pi;
      result.minDihedral = std::min(result.minDihedral, angle);
      result.maxDihedral = std::max(result.maxDihedral, angle);
    }
  }
  return result;
}

SINEW_ONCE SurfaceQuality surface_quality(Mesh const& mesh) {
  if (mesh.triangles.empty())
    throw Error("surface_quality", "the mesh has no triangles; give a surface mesh");
  check_mesh("surface_quality", mesh);
  SurfaceQuality result;
  std::vector<char> used(mesh.positions.size(), 0);
  std::vector<Edge> directed;
  directed.reserve(3 * mesh.triangles.size());
  for (Triangle const& t : mesh.triangles) {
    Eigen::Vector3d x[3];
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = mesh.positions[std::size_t(t[i])];
      used[std::size_t(t[i])] = 1;
      directed.push_back({t[i], t[(i + 1) % 3]});
    }
    const double twiceArea = (x[1] - x[0]).cross(x[2] - x[0]).norm();
    result.area += twiceArea / 2;
    result.volume += x[0].dot(x[1].cross(x[2])) / 6;
    for (int i = 0; i < 3; ++i) {
      const double cosine = (x[(i + 1) % 3] - x[i]).dot(x[(i + 2) % 3] - x[i]);
      const double angle = std::atan2(twiceArea, cosine) * 180 / std::numbers::pi;
      result.minAngle = std::min(result.minAngle, angle);
      result.maxAngle = std::max(result.maxAngle, angle);
    }
  }
  // closed: the directed edges are all different, and the reverse of each is there too
  std::vector<Edge> reversed(directed.size());
  std::transform(directed.begin(), directed.end(), reversed.begin(), [](Edge e) { return Edge{e[1], e[0]}; });
  std::sort(directed.begin(), directed.end());
  std::sort(reversed.begin(), reversed.end());
  result.closed =
      directed == reversed && std::adjacent_find(directed.begin(), directed.end()) == directed.end();
  result.manifold = result.closed && detail::has_single_rings(mesh.triangles, mesh.positions.size());
  result.eulerCharacteristic = int(std::count(used.begin(), used.end(), 1)) -
                               int(edges_of(mesh.triangles).size()) + int(mesh.triangles.size());
  return result;
}

}  // namespace sinew
#endif
