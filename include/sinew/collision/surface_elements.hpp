// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <span>
#include <vector>

namespace sinew {

using PrimitiveCorners = std::array<int, 3>;  // of a primitive, -1 behind the last

std::vector<PrimitiveCorners> points_of(TopologyView const&, std::size_t points);

/// The surface of the volume elements of a topology, oriented outwards, whatever of it is listed, so that it
/// is that of what is left when some are removed; then the triangles and quads that are no part of it. Quads
/// are cut in two, of which those that are triangles of the topology already are left out, and faces of
/// elements of second order between their nodes. Where positions are given, elements of negative volume have
/// their outside outside, too.
std::vector<PrimitiveCorners> triangles_of(TopologyView const& t,
                                           std::span<Eigen::Vector3d const> positions = {});

/// The edges of a topology; where it has none, those of its triangles (triangles_of), each once.
std::vector<PrimitiveCorners> lines_of(TopologyView const& t, std::size_t = 0);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <Eigen/LU>
#include <algorithm>

namespace sinew::detail {

// The sign of its volume: that of the determinant of its sides from a corner, or of the lines between the
// centres of opposite faces. Elements with a corner that has no position are left as they are.
template <std::size_t N>
bool is_inside_out(std::array<Index, N> const& element, std::span<Eigen::Vector3d const> positions) {
  const auto e = [&] {
    if constexpr (N == 4)
      return element;
    else if constexpr (N > 8)
      return corners_of(element);
    else
      return as_hexahedron(element);
  }();
  Eigen::Matrix3d sides = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < e.size(); ++k) {
    if (e[k] < 0 || std::size_t(e[k]) >= positions.size()) return false;
    const Eigen::Vector3d x = positions[std::size_t(e[k])] - positions[std::size_t(e[0])];
    if constexpr (N == 4 || N == 10) {
      if (k > 0) sides.col(Eigen::Index(k) - 1) = x;
    } else {
      for (int c = 0; c < 3; ++c) sides.col(c) += hexahedronCorners[k][c] == 1 ? x : Eigen::Vector3d(-x);
    }
  }
  return sides.determinant() < 0;
}
template <std::size_t N>
std::vector<std::array<Index, N>> oriented_outwards(std::span<std::array<Index, N> const> elements,
                                                    std::span<Eigen::Vector3d const> positions) {
  std::vector<std::array<Index, N>> all(elements.begin(), elements.end());
  for (auto& e : all)
    if (is_inside_out(e, positions)) {
      if constexpr (N == 4)
        std::swap(e[2], e[3]);
      else if constexpr (N == 5)
        std::swap(e[1], e[3]);
      else if constexpr (N > 8)
        turn_inside_out(e);
      else
        std::rotate(e.begin(), e.begin() + N / 2, e.end());
    }
  return all;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE std::vector<PrimitiveCorners> points_of(TopologyView const&, std::size_t points) {
  std::vector<PrimitiveCorners> all;
  for (int i = 0; i < int(points); ++i) all.push_back({i, -1, -1});
  return all;
}

SINEW_ONCE std::vector<PrimitiveCorners> triangles_of(TopologyView const& t,
                                                      std::span<Eigen::Vector3d const> positions) {
  std::vector<PrimitiveCorners> all, known;
  auto quad = [](Quad const& q) {
    return std::array<PrimitiveCorners, 2>{{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}};
  };
  const auto tetrahedra = detail::oriented_outwards<4>(t.tetrahedra, positions);
  const Border border = border_of(tetrahedra,
                                  detail::oriented_outwards<8>(t.hexahedra, positions),
                                  detail::oriented_outwards<5>(t.pyramids, positions),
                                  detail::oriented_outwards<6>(t.prisms, positions),
                                  detail::oriented_outwards<10>(t.quadraticTetrahedra, positions),
                                  detail::oriented_outwards<20>(t.quadraticHexahedra, positions),
                                  detail::oriented_outwards<27>(t.triquadraticHexahedra, positions));
  all.assign(border.triangles.begin(), border.triangles.end());
  for (PrimitiveCorners const& c : all) known.push_back(sorted_corners(c));
  for (Quad const& q : border.quads) {
    for (PrimitiveCorners const& c : quad(q)) all.push_back(c);
    for (std::size_t i = 0; i < 4; ++i)
      known.push_back(sorted_corners(PrimitiveCorners{q[i], q[(i + 1) % 4], q[(i + 2) % 4]}));
  }
  std::sort(known.begin(), known.end());
  auto add = [&](PrimitiveCorners const& c) {
    if (!std::binary_search(known.begin(), known.end(), sorted_corners(c))) all.push_back(c);
  };
  for (Triangle const& c : t.triangles) add(c);
  for (Triangle const& c : t.triangles) known.push_back(sorted_corners(c));  // grids list both
  std::sort(known.begin(), known.end());
  for (Quad const& q : t.quads)
    for (PrimitiveCorners const& c : quad(q)) add(c);
  return all;
}

SINEW_ONCE std::vector<PrimitiveCorners> lines_of(TopologyView const& t, std::size_t) {
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
#endif
