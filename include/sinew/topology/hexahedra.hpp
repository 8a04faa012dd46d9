// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <span>
#include <vector>

namespace sinew {

/// Corners of VTK's hexahedron in its own coordinates, each 0 or 1.
inline constexpr int hexahedronCorners[8][3] = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// Its faces, counter-clockwise seen from outside.
inline constexpr std::size_t hexahedronFaces[6][4] = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Six tetrahedra for each hexahedron, which match those of all neighbours: a face is cut from its
/// lowest-numbered corner, whichever side one looks from. The lowest corner of the cell is joined to the six
/// triangles of the three faces that it is not on. Positively oriented where the hexahedra are convex; a
/// sixth of a cell each in a grid, where this is Kuhn's subdivision (1960).
std::vector<Tetrahedron> hexahedra_to_tetrahedra(std::span<Hexahedron const> hexahedra);

/// Shape functions of the multilinear edge (Dim = 1), quad or hexahedron and their derivatives by its
/// coordinates, at a place whose coordinates are 0 to 1 inside.
template <int Dim>
struct MultilinearShape {
  static constexpr int corners = 1 << Dim;
  Eigen::Matrix<double, corners, 1> weights;
  Eigen::Matrix<double, corners, Dim> derivatives;

  explicit MultilinearShape(Eigen::Matrix<double, Dim, 1> const& place) {
    for (int k = 0; k < corners; ++k) {
      weights[k] = 1;
      derivatives.row(k).setOnes();
      for (int c = 0; c < Dim; ++c) {
        const bool high = hexahedronCorners[k][c] == 1;
        const double factor = high ? place[c] : 1 - place[c];
        weights[k] *= factor;
        for (int d = 0; d < Dim; ++d) derivatives(k, d) *= d != c ? factor : high ? 1 : -1;
      }
    }
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE std::vector<Tetrahedron> hexahedra_to_tetrahedra(std::span<Hexahedron const> hexahedra) {
  std::vector<Tetrahedron> tetrahedra;
  tetrahedra.reserve(6 * hexahedra.size());
  for (Hexahedron const& h : hexahedra) {
    const Index apex = *std::min_element(h.begin(), h.end());
    for (auto const& face : hexahedronFaces) {
      Quad f{h[face[0]], h[face[1]], h[face[2]], h[face[3]]};
      if (std::find(f.begin(), f.end(), apex) != f.end()) continue;
      std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
      tetrahedra.push_back({apex, f[0], f[1], f[2]});
      tetrahedra.push_back({apex, f[0], f[2], f[3]});
    }
  }
  return tetrahedra;
}

}  // namespace sinew
#endif
