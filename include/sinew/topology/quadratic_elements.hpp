// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <array>
#include <cstddef>
#include <utility>

namespace sinew {

// What elements of second order are made of: their corners, and the flat parts of their faces between all of
// their nodes, of which surfaces, pictures and contacts are.

constexpr Tetrahedron corners_of(QuadraticTetrahedron const& e) { return {e[0], e[1], e[2], e[3]}; }
constexpr Hexahedron corners_of(QuadraticHexahedron const& e) {
  return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7]};
}
constexpr Hexahedron corners_of(TriquadraticHexahedron const& e) {
  return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7]};
}

/// Turns an element inside out: corners 2 and 3 of a tetrahedron, or the first and the opposite face of a
/// hexahedron, change places, and so do the nodes between.
constexpr void turn_inside_out(QuadraticTetrahedron& e) {
  std::swap(e[2], e[3]), std::swap(e[5], e[8]), std::swap(e[6], e[7]);
}
template <std::size_t N>
constexpr void turn_inside_out(std::array<Index, N>& e) {
  static_assert(N == 20 || N == 27);
  for (std::size_t k = 0; k < 4; ++k) std::swap(e[k], e[k + 4]), std::swap(e[k + 8], e[k + 12]);
  if constexpr (N == 27) std::swap(e[24], e[25]);
}

namespace detail {

/// The numbers of the ends and of the middle of each edge of a quadratic tetrahedron, and of a hexahedron.
inline constexpr std::array<std::array<std::size_t, 3>, 6> quadraticTetrahedronEdges{
    {{0, 1, 4}, {1, 2, 5}, {2, 0, 6}, {0, 3, 7}, {1, 3, 8}, {2, 3, 9}}};
inline constexpr std::array<std::array<std::size_t, 3>, 12> quadraticHexahedronEdges{{{0, 1, 8},
                                                                                      {1, 2, 9},
                                                                                      {2, 3, 10},
                                                                                      {3, 0, 11},
                                                                                      {4, 5, 12},
                                                                                      {5, 6, 13},
                                                                                      {6, 7, 14},
                                                                                      {7, 4, 15},
                                                                                      {0, 4, 16},
                                                                                      {1, 5, 17},
                                                                                      {2, 6, 18},
                                                                                      {3, 7, 19}}};
/// The corners of the faces of a hexahedron in the order of their middles, counter-clockwise seen from
/// outside.
inline constexpr std::size_t triquadraticFaces[6][4] = {
    {0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

/// Where the 27 nodes of a hexahedron are, in coordinates from -1 to 1.
struct TriquadraticPlaces {
  double at[27][3]{};

  constexpr TriquadraticPlaces() {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 8; ++k) at[k][c] = 2. * hexahedronCorners[k][c] - 1;
      for (auto const& [i, j, middle] : quadraticHexahedronEdges) at[middle][c] = (at[i][c] + at[j][c]) / 2;
      for (std::size_t f = 0; f < 6; ++f)
        at[20 + f][c] = (at[triquadraticFaces[f][0]][c] + at[triquadraticFaces[f][2]][c]) / 2;
    }
  }
};
inline constexpr TriquadraticPlaces triquadraticPlaces{};

template <std::size_t N>
constexpr std::size_t middle_of(std::array<std::array<std::size_t, 3>, N> const& edges, std::size_t a,
                                std::size_t b) {
  for (auto const& [i, j, middle] : edges)
    if ((i == a && j == b) || (i == b && j == a)) return middle;
  return 0;
}

}  // namespace detail

/// The eight linear elements between all nodes, whose faces outside are the parts of faces below.
constexpr std::array<Tetrahedron, 8> parts_of(QuadraticTetrahedron const& e) {
  return {{{e[0], e[4], e[6], e[7]},
           {e[4], e[1], e[5], e[8]},
           {e[6], e[5], e[2], e[9]},
           {e[7], e[8], e[9], e[3]},
           {e[4], e[9], e[6], e[5]},
           {e[4], e[9], e[7], e[6]},
           {e[4], e[9], e[8], e[7]},
           {e[4], e[9], e[5], e[8]}}};
}
constexpr std::array<Hexahedron, 8> parts_of(TriquadraticHexahedron const& e) {
  std::array<Hexahedron, 8> parts{};
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t k = 0; k < 8; ++k)
      for (std::size_t node = 0; node < 27; ++node) {
        bool here = true;
        for (std::size_t c = 0; c < 3; ++c)
          here = here && detail::triquadraticPlaces.at[node][c] ==
                             hexahedronCorners[p][c] + hexahedronCorners[k][c] - 1;
        if (here) parts[p][k] = e[node];
      }
  return parts;
}

/// Faces whose sides have a middle, by the nodes c of their corners and m of the sides behind them. Of a
/// triangle four triangles; of a quad without a node inside four triangles and a quad; of one with the node
/// inside four quads.
template <class Node>
constexpr std::array<std::array<Node, 3>, 4> parts_of_triangle(std::array<Node, 3> const& c,
                                                               std::array<Node, 3> const& m) {
  return {{{c[0], m[0], m[2]}, {c[1], m[1], m[0]}, {c[2], m[2], m[1]}, {m[0], m[1], m[2]}}};
}
template <class Node>
constexpr std::array<std::array<Node, 3>, 4> corner_parts_of_quad(std::array<Node, 4> const& c,
                                                                  std::array<Node, 4> const& m) {
  return {{{c[0], m[0], m[3]}, {c[1], m[1], m[0]}, {c[2], m[2], m[1]}, {c[3], m[3], m[2]}}};
}
template <class Node>
constexpr std::array<std::array<Node, 4>, 4> parts_of_quad(std::array<Node, 4> const& c,
                                                           std::array<Node, 4> const& m, Node inside) {
  return {{{c[0], m[0], inside, m[3]},
           {m[0], c[1], m[1], inside},
           {inside, m[1], c[2], m[2]},
           {m[3], inside, m[2], c[3]}}};
}

/// Nodes of the parts of all faces, counter-clockwise seen from outside.
struct QuadraticFaces {
  std::size_t tetrahedron[16][3]{}, hexahedronTriangles[24][3]{}, hexahedronQuads[6][4]{},
      triquadraticQuads[24][4]{};

  constexpr QuadraticFaces() {
    constexpr std::size_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    auto copy = [](auto const& from, auto& to) {
      for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[k];
    };
    for (std::size_t f = 0; f < 4; ++f) {
      std::array<std::size_t, 3> c{}, m{};
      for (std::size_t k = 0; k < 3; ++k) {
        c[k] = triangles[f][k];
        m[k] = detail::middle_of(detail::quadraticTetrahedronEdges, c[k], triangles[f][(k + 1) % 3]);
      }
      const auto parts = parts_of_triangle(c, m);
      for (std::size_t p = 0; p < 4; ++p) copy(parts[p], tetrahedron[4 * f + p]);
    }
    for (std::size_t f = 0; f < 6; ++f) {
      std::array<std::size_t, 4> c{}, m{};
      for (std::size_t k = 0; k < 4; ++k) {
        c[k] = detail::triquadraticFaces[f][k];
        m[k] = detail::middle_of(
            detail::quadraticHexahedronEdges, c[k], detail::triquadraticFaces[f][(k + 1) % 4]);
      }
      const auto atCorners = corner_parts_of_quad(c, m);
      const auto quads = parts_of_quad(c, m, 20 + f);
      copy(m, hexahedronQuads[f]);
      for (std::size_t p = 0; p < 4; ++p) {
        copy(atCorners[p], hexahedronTriangles[4 * f + p]);
        copy(quads[p], triquadraticQuads[4 * f + p]);
      }
    }
  }
};
inline constexpr QuadraticFaces quadraticFaces{};

}  // namespace sinew
