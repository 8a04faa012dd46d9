// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sinew {

constexpr bool is_simplex(int kind) {
  return kind == int(ElementKind::edge) || kind == int(ElementKind::triangle) ||
         kind == int(ElementKind::tetrahedron);
}
/// Quads and hexahedra, whose sides lie along the axes of a grid.
constexpr bool is_cell(int kind) {
  return kind == int(ElementKind::quad) || kind == int(ElementKind::hexahedron);
}

/// The axes along which two corners of a quad or a hexahedron are apart, as bits: one for a side, more for a
/// diagonal.
constexpr int axes_between(std::size_t a, std::size_t b) {
  int axes = 0;
  for (int c = 0; c < 3; ++c)
    if (hexahedronCorners[a][c] != hexahedronCorners[b][c]) axes |= 1 << c;
  return axes;
}

/// f(edge) for each two points of an element.
template <std::size_t N, class F>
void for_each_edge(std::array<Index, N> const& element, F&& f) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = i + 1; k < N; ++k)
      f(Edge{std::min(element[i], element[k]), std::max(element[i], element[k])});
}
/// f(axis, edge) for each side of a quad or a hexahedron.
template <std::size_t N, class F>
void for_each_cell_side(std::array<Index, N> const& cell, F&& f) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = i + 1; k < N; ++k)
      if (const int axes = axes_between(i, k); axes == 1 || axes == 2 || axes == 4)
        f(axes / 2, Edge{std::min(cell[i], cell[k]), std::max(cell[i], cell[k])});
}
/// f(edge) for each side of an edge, triangle, quad, tetrahedron or hexahedron.
template <std::size_t N, class F>
void for_each_side(int kind, std::array<Index, N> const& element, F&& f) {
  if constexpr (N == 4 || N == 8)
    if (is_cell(kind)) return for_each_cell_side(element, [&](int, Edge const& e) { f(e); });
  for_each_edge(element, f);
}

/// f(face) for each quad and each face of a hexahedron, corners in a circle.
template <class F>
void for_each_quad_face(TopologyView const& body, F&& f) {
  for (Quad const& q : body.quads) f(q);
  for (Hexahedron const& h : body.hexahedra)
    for (auto const& face : hexahedronFaces) f(Quad{h[face[0]], h[face[1]], h[face[2]], h[face[3]]});
}

/// The sides of the quads and hexahedra of a body, those together that are of one sheet.
class EdgeSheets {
 public:
  explicit EdgeSheets(TopologyView const& body) {
    forEachCell(body, [&](auto const& cell) {
      for_each_cell_side(cell, [&](int, Edge const& e) { sides_.push_back(e); });
    });
    std::sort(sides_.begin(), sides_.end());
    sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
    sheet_.resize(sides_.size());
    std::iota(sheet_.begin(), sheet_.end(), std::size_t(0));
    forEachCell(body, [&](auto const& cell) {
      std::size_t first[3] = {none, none, none};
      for_each_cell_side(cell, [&](int axis, Edge const& e) {
        const std::size_t side = sheet(find(e));
        if (first[axis] == none) first[axis] = side;
        sheet_[side] = first[axis] = sheet(first[axis]);
      });
    });
  }
  bool isSide(Edge const& e) const { return find(e) != none; }
  /// With these edges all that are of a sheet with one of them, in order and once.
  std::vector<Edge> whole(std::vector<Edge> edges) {
    std::vector<bool> split(sides_.size(), false);
    for (Edge const& e : edges)
      if (const std::size_t side = find(e); side != none) split[sheet(side)] = true;
    for (std::size_t side = 0; side < sides_.size(); ++side)
      if (split[sheet(side)]) edges.push_back(sides_[side]);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

 private:
  static constexpr auto none = std::size_t(-1);
  std::vector<Edge> sides_{};
  std::vector<std::size_t> sheet_{};  // of each another one of its sheet, the first of it in the end

  template <class F>
  static void forEachCell(TopologyView const& body, F&& f) {
    for (Quad const& q : body.quads) f(q);
    for (Hexahedron const& h : body.hexahedra) f(h);
  }
  std::size_t find(Edge const& e) const {
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), e);
    return found == sides_.end() || *found != e ? none : std::size_t(found - sides_.begin());
  }
  std::size_t sheet(std::size_t side) {
    while (sheet_[side] != side) side = sheet_[side] = sheet_[sheet_[side]];
    return side;
  }
};

}  // namespace sinew
