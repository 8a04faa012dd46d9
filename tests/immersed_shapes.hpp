// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <Eigen/Geometry>

#include <map>
#include <vector>

// Closed surfaces for solids in fluids on grids.
namespace shapes {

/// An octahedron whose faces are cut into four so many times, on a sphere around `centre`.
inline sinew::Mesh sphere(double radius, int cuts, Eigen::Vector3d const& centre = {0, 0, 0}) {
  using namespace sinew;
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Index x : {0, 1})
    for (const Index y : {2, 3})
      for (const Index z : {4, 5})
        mesh.triangles.push_back((x + y + z) % 2 == 0 ? Triangle{x, y, z} : Triangle{y, x, z});
  for (int k = 0; k < cuts; ++k) {
    std::map<Edge, Index> middles;
    auto middle = [&](Index a, Index b) {
      const auto [at, isNew] =
          middles.insert({{std::min(a, b), std::max(a, b)}, Index(mesh.positions.size())});
      if (isNew)
        mesh.positions.push_back(
            (mesh.positions[std::size_t(a)] + mesh.positions[std::size_t(b)]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (auto const& [a, b, c] : mesh.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (auto const& t :
           {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (auto& x : mesh.positions) x = centre + radius * x;
  return mesh;
}

/// The faces of a box.
inline sinew::Mesh box(Eigen::Vector3d const& low, Eigen::Vector3d const& high) {
  sinew::Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.positions.emplace_back((k & 1 ? high : low)[0], (k & 2 ? high : low)[1], (k & 4 ? high : low)[2]);
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

/// Of what triangles enclose.
inline double volume(sinew::Mesh const& mesh) {
  double sum = 0;
  for (auto const& [a, b, c] : mesh.triangles)
    sum += mesh.positions[std::size_t(a)].dot(
               mesh.positions[std::size_t(b)].cross(mesh.positions[std::size_t(c)])) /
           6;
  return std::abs(sum);
}

}  // namespace shapes
