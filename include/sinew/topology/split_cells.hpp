// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/renumbering.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/topology/split_edges.hpp>

#include <map>
#include <span>
#include <vector>

namespace sinew {

/// Parts of quads and hexahedra with split edges, as the coordinates of the multilinear cell are halved:
/// along one axis 2, along two 4, along three 8, with the orientation of the whole, which they fill. A point
/// amid a face or a hexahedron is that between two new ones, the mean of the corners.
class SplitCells {
 public:
  /// Numbers new points from `points` on, those amid edges first.
  SplitCells(SplitEdges const& edges, std::size_t points, std::vector<Origin>& come)
      : edges_(edges), points_(points), come_(come) {
    auto const& diagonals = edges.diagonals();
    for (Edge const& e : edges.inOrder()) {
      middles_.push_back(Index(points + come.size()));
      if (!diagonals.contains(e)) come.push_back({e[0], e[1], 0.5});
    }
    for (auto const& [e, face] : diagonals)
      middles_[std::size_t(edges.rank(e))] = amid(std::array{face[0], face[1], face[3], face[2]});
  }
  /// The point amid a split edge, by its rank.
  Index middle(Index rank) const { return middles_[std::size_t(rank)]; }

  /// x fastest; the cell itself where none of its edges is split.
  template <std::size_t N>
  std::vector<std::array<Index, N>> parts(std::array<Index, N> const& cell) {
    static_assert(N == 4 || N == 8);
    const int split = edges_.axes(cell);
    if (split == 0) return {cell};
    int halves[3];
    for (int c = 0; c < 3; ++c) halves[c] = split >> c & 1;
    // the points of the halved cell by their places in halves of its sides
    Index grid[3][3][3];
    for (int z = 0; z < (N == 8 ? 3 : 1); z += 2 - halves[2])
      for (int y = 0; y < 3; y += 2 - halves[1])
        for (int x = 0; x < 3; x += 2 - halves[0]) grid[z][y][x] = pointAt(cell, {x, y, z});
    std::vector<std::array<Index, N>> all;
    for (int z = 0; z <= halves[2]; ++z)
      for (int y = 0; y <= halves[1]; ++y)
        for (int x = 0; x <= halves[0]; ++x) {
          auto& part = all.emplace_back();
          for (std::size_t k = 0; k < N; ++k) {
            auto const& [cx, cy, cz] = hexahedronCorners[k];
            part[k] = grid[z + cz * (2 - halves[2])][y + cy * (2 - halves[1])][x + cx * (2 - halves[0])];
          }
        }
    return all;
  }

 private:
  SplitEdges const& edges_;
  std::size_t points_;
  std::vector<Origin>& come_;
  std::vector<Index> middles_{};
  std::map<Quad, Index> ofFaces_{};

  // between the corners at both ends of each axis on which the place is in the middle
  template <std::size_t N>
  Index pointAt(std::array<Index, N> const& cell, std::array<int, 3> const& place) {
    std::array<Index, 8> around;
    std::size_t count = 1;
    for (const int at : place) count *= at == 1 ? 2 : 1;
    for (std::size_t k = 0; k < count; ++k) {
      int end[3];
      for (std::size_t c = 0, bit = 0; c < 3; ++c)
        end[c] = place[c] == 1 ? int(k >> bit++ & 1) : place[c] / 2;
      around[k] = cell[std::size_t(4 * end[2] + (end[1] == 0 ? end[0] : 3 - end[0]))];
    }
    return amid({around.data(), count});
  }
  // the halves of the corners are opposite sides or faces
  Index amid(std::span<Index const> corners) {
    if (corners.size() == 1) return corners[0];
    if (corners.size() == 2)
      return middle(edges_.rank({std::min(corners[0], corners[1]), std::max(corners[0], corners[1])}));
    if (corners.size() == 8) return between(corners);
    const auto [known, fresh] =
        ofFaces_.try_emplace(sorted_corners(Quad{corners[0], corners[1], corners[2], corners[3]}), -1);
    if (fresh) known->second = between(corners);
    return known->second;
  }
  Index between(std::span<Index const> corners) {
    const std::size_t half = corners.size() / 2;
    const Index a = amid(corners.first(half)), b = amid(corners.last(half));
    come_.push_back({a, b, 0.5});
    return Index(points_ + come_.size()) - 1;
  }
};

}  // namespace sinew
