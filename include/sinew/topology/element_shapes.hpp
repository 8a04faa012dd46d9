// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <array>
#include <cstddef>

namespace sinew {

// Shape functions of elements in space, as laws of elements ask for them: how many nodes there are; the
// places and weights of the Gauss points at which forces are summed, in the coordinates of a reference
// element; and slope(i, k, q), the derivative of the shape function of node i by coordinate k at a place q.
// The sums of slopes are exact for straight and for warped elements, so that these pass the patch test.

template <std::size_t N>
using ReferencePlaces = std::array<std::array<double, 3>, N>;

/// Prism: the triangle (0, 0), (1, 0), (0, 1) of r and s times the line of t from 0 to 1. With the weights
/// L = (1 - r - s, r, s) of the triangle
///   N_i = L_i (1 - t),   N_(i + 3) = L_i t
/// and six Gauss points, three of degree two in the triangle above each other. (SOFA has two, above its
/// centre, which do not feel that the two triangles turn against each other.)
struct PrismShape {
  static constexpr std::size_t nodes = 6, points = 6;
  static constexpr double a = 1. / 6, b = 2. / 3;
  static constexpr double low = 0.21132486540518711775, high = 1 - low;  // (1 -+ 1/sqrt 3)/2
  static constexpr ReferencePlaces<6> places{
      {{a, a, low}, {b, a, low}, {a, b, low}, {a, a, high}, {b, a, high}, {a, b, high}}};
  static constexpr double weight(std::size_t) { return 1. / 12; }

  static constexpr double slope(int i, int k, std::array<double, 3> const& q) {
    const double corner[3] = {1 - q[0] - q[1], q[0], q[1]}, byCorner[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    if (k == 2) return i < 3 ? -corner[i] : corner[i - 3];
    return byCorner[i % 3][k] * (i < 3 ? 1 - q[2] : q[2]);
  }
};

/// Pyramid: a hexahedron whose upper four corners are one (Bedrosian 1992), with coordinates from -1 to 1.
///   N_i = (1 +- xi)(1 +- eta)(1 - zeta)/8,   N_4 = (1 + zeta)/2
/// and the eight Gauss points of the cube, as in SOFA. On its faces these are the functions of the quad and
/// of the triangles beside it.
struct PyramidShape {
  static constexpr std::size_t nodes = 5, points = 8;
  static constexpr double g = 0.57735026918962576451;  // 1/sqrt 3
  static constexpr ReferencePlaces<8> places{
      {{-g, -g, -g}, {g, -g, -g}, {-g, g, -g}, {g, g, -g}, {-g, -g, g}, {g, -g, g}, {-g, g, g}, {g, g, g}}};
  static constexpr double weight(std::size_t) { return 1; }

  static constexpr double slope(int i, int k, std::array<double, 3> const& q) {
    if (i == 4) return k == 2 ? 0.5 : 0;
    const double x = i == 0 || i == 3 ? -1 : 1, y = i < 2 ? -1 : 1;
    const double factors[3] = {1 + x * q[0], 1 + y * q[1], 1 - q[2]}, signs[3] = {x, y, -1};
    return signs[k] * factors[(k + 1) % 3] * factors[(k + 2) % 3] / 8;
  }
};

/// The slopes of all nodes at all Gauss points of a shape.
template <class Shape>
struct ShapeSlopes {
  double at[Shape::points][Shape::nodes][3];

  constexpr ShapeSlopes() : at{} {
    for (std::size_t g = 0; g < Shape::points; ++g)
      for (std::size_t i = 0; i < Shape::nodes; ++i)
        for (int k = 0; k < 3; ++k) at[g][i][k] = Shape::slope(int(i), k, Shape::places[g]);
  }
};
template <class Shape>
inline constexpr ShapeSlopes<Shape> shape_slopes{};

}  // namespace sinew
