// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sinew {

/// Corners of VTK's hexahedron in its own coordinates, each 0 or 1.
inline constexpr int hexahedronCorners[8][3] = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// Its faces, counter-clockwise seen from outside.
inline constexpr std::size_t hexahedronFaces[6][4] = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// A pyramid or prism as the hexahedron that it is where corners coincide: the upper four are its apex, or
/// those at y = 1 are two. Its shape functions are the sums of those of the corners that do.
constexpr Hexahedron as_hexahedron(Hexahedron const& h) { return h; }
constexpr Hexahedron as_hexahedron(Pyramid const& p) {
  return {p[0], p[1], p[2], p[3], p[4], p[4], p[4], p[4]};
}
constexpr Hexahedron as_hexahedron(Prism const& p) {
  return {p[0], p[1], p[2], p[2], p[3], p[4], p[5], p[5]};
}

/// Six tetrahedra for each hexahedron, which match those of all neighbours: a face is cut from its
/// lowest-numbered corner, whichever side one looks from. The lowest corner of the cell is joined to the six
/// triangles of the three faces that it is not on. Positively oriented where the hexahedra are convex; a
/// sixth of a cell each in a grid, where this is Kuhn's subdivision (1960).
std::vector<Tetrahedron> hexahedra_to_tetrahedra(std::span<Hexahedron const> hexahedra);

/// The grid that elements are of, x fastest, by its points each way, zeros for none; and whether its cells
/// are mirrored alternately along each axis before they are cut.
struct GridCells {
  std::array<int, 3> points{0, 0, 0};
  bool swapping = false;

  /// Cells each way, and what SOFA takes for them where there is no grid.
  std::array<int, 3> each() const {
    if (points[0] == 0) return {2, 1, 1};
    return {points[0] - 1, points[1] - 1, points[2] - 1};
  }
};

/// Six tetrahedra for each hexahedron, cut as in SOFA: four around the diagonal from corner 0 to 6, and those
/// at the corners 2 and 4. In a grid neighbours match so; where they do not, all are cut as above. Those of
/// mirrored cells, which would be inside out, have their points `exchanged` and `exchanged` + 1 swapped.
std::vector<Tetrahedron> hexahedra_to_tetrahedra(std::span<Hexahedron const> hexahedra, GridCells const& grid,
                                                 std::size_t exchanged);

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

/// The integrals of N_i N_j over the multilinear quad or hexahedron with these corners. Three Gauss points a
/// direction are exact to degree five; N_i N_j det J has four at most.
template <int Dim>
Eigen::Matrix<double, 1 << Dim, 1 << Dim> multilinear_mass(Eigen::Matrix<double, 3, 1 << Dim> const& x) {
  constexpr int corners = 1 << Dim;
  Eigen::Matrix<double, corners, corners> mass;
  mass.setZero();
  const double node[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
               weight[3] = {5. / 18, 4. / 9, 5. / 18};
  for (int q = 0; q < (Dim == 3 ? 27 : 9); ++q) {
    Eigen::Matrix<double, Dim, 1> place;
    double w = 1;
    for (int c = 0, rest = q; c < Dim; ++c, rest /= 3) place[c] = node[rest % 3], w *= weight[rest % 3];
    const MultilinearShape<Dim> shape(place);
    const Eigen::Matrix<double, 3, Dim> J = x * shape.derivatives;
    mass += w * std::sqrt((J.transpose() * J).determinant()) * shape.weights * shape.weights.transpose();
  }
  return mass;
}

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <map>
#include <utility>

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

SINEW_ONCE std::vector<Tetrahedron> hexahedra_to_tetrahedra(std::span<Hexahedron const> hexahedra,
                                                            GridCells const& grid, std::size_t exchanged) {
  constexpr std::size_t parts[6][4] = {
      {0, 5, 1, 6}, {0, 1, 3, 6}, {1, 3, 6, 2}, {6, 3, 0, 7}, {6, 7, 0, 5}, {7, 5, 4, 0}};
  // they cut the faces between the first and third of these corners
  constexpr std::size_t faces[6][4] = {
      {1, 2, 3, 0}, {5, 6, 7, 4}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}};
  const std::array<int, 3> n = grid.each();
  const std::size_t row = std::size_t(std::max(n[0], 1)), column = std::size_t(std::max(n[1], 1));
  std::map<Quad, Edge> cutBy;
  std::vector<Tetrahedron> tetrahedra;
  tetrahedra.reserve(6 * hexahedra.size());
  for (std::size_t i = 0; i < hexahedra.size(); ++i) {
    const bool mirrored[3] = {i % row % 2 == 0, i / row % column % 2 == 1, i / (row * column) % 2 == 1};
    Hexahedron c = hexahedra[i];
    bool insideOut = false;
    for (std::size_t axis = 0; axis < 3 && grid.swapping; ++axis) {
      if (!mirrored[axis]) continue;
      insideOut = !insideOut;
      for (std::size_t k = 0; k < 8; ++k) {
        std::array<int, 3> other{hexahedronCorners[k][0], hexahedronCorners[k][1], hexahedronCorners[k][2]};
        if (std::exchange(other[axis], 1) == 1) continue;
        for (std::size_t l = 0; l < 8; ++l)
          if (std::equal(other.begin(), other.end(), hexahedronCorners[l])) std::swap(c[k], c[l]);
      }
    }
    for (auto const& f : faces) {
      Quad face{c[f[0]], c[f[1]], c[f[2]], c[f[3]]};
      const Edge diagonal{std::min(face[0], face[2]), std::max(face[0], face[2])};
      std::sort(face.begin(), face.end());
      if (cutBy.try_emplace(face, diagonal).first->second != diagonal)
        return hexahedra_to_tetrahedra(hexahedra);
    }
    for (auto const& t : parts) {
      tetrahedra.push_back({c[t[0]], c[t[1]], c[t[2]], c[t[3]]});
      if (insideOut) std::swap(tetrahedra.back()[exchanged], tetrahedra.back()[exchanged + 1]);
    }
  }
  return tetrahedra;
}

}  // namespace sinew
#endif
