// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace sinew {

using PrimitiveCorners = std::array<int, 3>;  // of a primitive, -1 behind the last

inline std::vector<PrimitiveCorners> points_of(TopologyView const&, std::size_t points) {
  std::vector<PrimitiveCorners> all;
  for (int i = 0; i < int(points); ++i) all.push_back({i, -1, -1});
  return all;
}

/// The triangles of a topology, quads cut in two; where it has neither, those of the surface of its
/// tetrahedra and hexahedra, turned outwards.
inline std::vector<PrimitiveCorners> triangles_of(TopologyView const& t, std::size_t = 0) {
  std::vector<PrimitiveCorners> all(t.triangles.begin(), t.triangles.end());
  auto quad = [&](int a, int b, int c, int d) {
    all.push_back({a, b, c});
    all.push_back({a, c, d});
  };
  for (Quad const& q : t.quads) quad(q[0], q[1], q[2], q[3]);
  if (!all.empty()) return all;

  // a face of one volume element only is on the surface; kept in the order in which elements give them
  std::map<std::vector<int>, int> times;
  auto key = [](std::vector<int> face) {
    std::sort(face.begin(), face.end());
    return face;
  };
  std::vector<std::vector<int>> faces;
  auto add = [&](std::vector<int> face) {
    ++times[key(face)];
    faces.push_back(std::move(face));
  };
  for (Tetrahedron const& e : t.tetrahedra) {
    add({e[0], e[2], e[1]});
    add({e[0], e[1], e[3]});
    add({e[1], e[2], e[3]});
    add({e[0], e[3], e[2]});
  }
  for (Hexahedron const& e : t.hexahedra) {
    add({e[0], e[3], e[2], e[1]});
    add({e[4], e[5], e[6], e[7]});
    add({e[0], e[1], e[5], e[4]});
    add({e[1], e[2], e[6], e[5]});
    add({e[2], e[3], e[7], e[6]});
    add({e[3], e[0], e[4], e[7]});
  }
  for (auto const& face : faces) {
    if (times[key(face)] != 1) continue;
    if (face.size() == 3)
      all.push_back({face[0], face[1], face[2]});
    else
      quad(face[0], face[1], face[2], face[3]);
  }
  return all;
}

/// The edges of a topology; where it has none, those of its triangles (triangles_of), each once.
inline std::vector<PrimitiveCorners> lines_of(TopologyView const& t, std::size_t = 0) {
  std::vector<PrimitiveCorners> all;
  for (Edge const& e : t.edges) all.push_back({e[0], e[1], -1});
  if (!all.empty()) return all;
  for (PrimitiveCorners const& triangle : triangles_of(t))
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [a, b] = std::minmax(triangle[c], triangle[(c + 1) % 3]);
      all.push_back({a, b, -1});
    }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace sinew
