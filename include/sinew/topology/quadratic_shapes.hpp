// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_shapes.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quadratic_elements.hpp>

#include <Eigen/Core>
#include <array>

namespace sinew {

// Shape functions of second order, as element_shapes.hpp has those of first order; besides, value(i, q) is
// that of node i at a place q, for masses. Sums of slopes are exact for elements with curved edges and faces,
// too, so that these pass the patch test.

/// Tetrahedron of ten nodes (Zienkiewicz & Taylor, The Finite Element Method, 1: chapter 8). With the weights
/// L = (1 - r - s - t, r, s, t)
///   N_a = L_a (2 L_a - 1) at corners,   N_ab = 4 L_a L_b between them
/// The slopes times the cofactors of J are of degree three, to which the eight points (Witherden & Vincent
/// 2015) are exact.
struct QuadraticTetrahedronShape {
  static constexpr std::size_t nodes = 10, points = 8;
  static constexpr bool collapsed = true;  // of the reference cube
  static constexpr double a = 0.32816330251638171, b = 0.10804724989842859, ofA = 0.13621784253708735 / 6;
  static constexpr ReferencePlaces<8> places{{{a, a, a},
                                              {1 - 3 * a, a, a},
                                              {a, 1 - 3 * a, a},
                                              {a, a, 1 - 3 * a},
                                              {b, b, b},
                                              {1 - 3 * b, b, b},
                                              {b, 1 - 3 * b, b},
                                              {b, b, 1 - 3 * b}}};
  static constexpr double weight(std::size_t g) { return g < 4 ? ofA : 1. / 24 - ofA; }

  static constexpr double value(int i, std::array<double, 3> const& q) {
    const double l[4] = {1 - q[0] - q[1] - q[2], q[0], q[1], q[2]};
    if (i < 4) return l[i] * (2 * l[i] - 1);
    auto const& edge = detail::quadraticTetrahedronEdges[std::size_t(i) - 4];
    return 4 * l[edge[0]] * l[edge[1]];
  }
  static constexpr double slope(int i, int k, std::array<double, 3> const& q) {
    const double l[4] = {1 - q[0] - q[1] - q[2], q[0], q[1], q[2]};
    auto by = [k](std::size_t corner) { return corner == 0 ? -1. : corner == std::size_t(k) + 1 ? 1. : 0.; };
    if (i < 4) return (4 * l[i] - 1) * by(std::size_t(i));
    auto const& edge = detail::quadraticTetrahedronEdges[std::size_t(i) - 4];
    return 4 * (by(edge[0]) * l[edge[1]] + l[edge[0]] * by(edge[1]));
  }
};

namespace detail {

/// Three Gauss points a direction: products of slopes and cofactors are of degree five in each coordinate.
struct TriquadraticPoints {
  static constexpr std::size_t points = 27;
  static constexpr bool collapsed = false;
  static constexpr double g = 0.77459666924148337704;  // sqrt(3/5)
  static constexpr double line[3] = {-g, 0, g}, weights[3] = {5. / 9, 8. / 9, 5. / 9};
  static constexpr ReferencePlaces<27> places = [] {
    ReferencePlaces<27> all{};
    for (std::size_t p = 0; p < 27; ++p) all[p] = {line[p % 3], line[p / 3 % 3], line[p / 9]};
    return all;
  }();
  static constexpr double weight(std::size_t p) {
    return weights[p % 3] * weights[p / 3 % 3] * weights[p / 9];
  }
};

}  // namespace detail

/// Hexahedron of 20 nodes, the "serendipity" one (Zienkiewicz & Taylor, chapter 8), with coordinates from -1
/// to 1. With c = (x_i x, y_i y, z_i z) of a node at (x_i, y_i, z_i)
///   N_i = (1 + c_1)(1 + c_2)(1 + c_3)(c_1 + c_2 + c_3 - 2)/8 at corners
///   N_i = (1 - x^2)(1 + c_2)(1 + c_3)/4 in the middle of an edge along x, and so on
struct QuadraticHexahedronShape : detail::TriquadraticPoints {
  static constexpr std::size_t nodes = 20;

  static constexpr double value(int i, std::array<double, 3> const& q) {
    auto const& at = detail::triquadraticPlaces.at[i];
    double product = i < 8 ? 1. / 8 : 1. / 4, sum = -2;
    for (std::size_t c = 0; c < 3; ++c) {
      product *= at[c] == 0 ? 1 - q[c] * q[c] : 1 + at[c] * q[c];
      sum += at[c] * q[c];
    }
    return i < 8 ? product * sum : product;
  }
  static constexpr double slope(int i, int k, std::array<double, 3> const& q) {
    auto const& at = detail::triquadraticPlaces.at[i];
    double others = i < 8 ? 1. / 8 : 1. / 4, sum = -2;
    for (std::size_t c = 0; c < 3; ++c) {
      if (int(c) != k) others *= at[c] == 0 ? 1 - q[c] * q[c] : 1 + at[c] * q[c];
      sum += at[c] * q[c];
    }
    const double x = q[std::size_t(k)], s = at[k];
    if (i < 8) return others * s * (sum + 1 + s * x);
    return s == 0 ? -2 * x * others : s * others;
  }
};

/// Hexahedron of 27 nodes, with coordinates from -1 to 1: the product of the polynomials of degree two of
/// each coordinate that are 1 at the node and 0 at the others,
///   N_i = n(x, x_i) n(y, y_i) n(z, z_i),   n(x, +-1) = x (x +- 1)/2,   n(x, 0) = 1 - x^2
struct TriquadraticHexahedronShape : detail::TriquadraticPoints {
  static constexpr std::size_t nodes = 27;

  static constexpr double along(double at, double x) { return at == 0 ? 1 - x * x : x * (x + at) / 2; }
  static constexpr double slopeAlong(double at, double x) { return at == 0 ? -2 * x : x + at / 2; }
  static constexpr double value(int i, std::array<double, 3> const& q) {
    auto const& at = detail::triquadraticPlaces.at[i];
    return along(at[0], q[0]) * along(at[1], q[1]) * along(at[2], q[2]);
  }
  static constexpr double slope(int i, int k, std::array<double, 3> const& q) {
    auto const& at = detail::triquadraticPlaces.at[i];
    double product = 1;
    for (std::size_t c = 0; c < 3; ++c) product *= int(c) == k ? slopeAlong(at[c], q[c]) : along(at[c], q[c]);
    return product;
  }
};

/// The integrals of N_i N_j over an element of second order with these nodes. N_i N_j det J has degree nine
/// at most in each coordinate of the cube, of which a tetrahedron is a part where opposite faces collapse to
/// points: five Gauss points a direction are exact.
Eigen::Matrix<double, 10, 10> quadratic_mass(Eigen::Matrix<double, 3, 10> const& x);
Eigen::Matrix<double, 20, 20> quadratic_mass(Eigen::Matrix<double, 3, 20> const& x);
Eigen::Matrix<double, 27, 27> quadratic_mass(Eigen::Matrix<double, 3, 27> const& x);

/// A mass for each node of an element of which this is the consistent one. Row sums would be negative at the
/// corners of quadratic elements; so the diagonal is, in proportion (Hinton, Rock, Zienkiewicz 1976).
template <int Nodes>
Eigen::Matrix<double, Nodes, 1> lumped_mass(Eigen::Matrix<double, Nodes, Nodes> const& consistent) {
  double sum = 0, trace = 0;
  for (int i = 0; i < Nodes; ++i) {
    trace += consistent(i, i);
    for (int k = 0; k < Nodes; ++k) sum += consistent(i, k);
  }
  return consistent.diagonal() * (sum / trace);
}

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/LU>
#include <cmath>

namespace sinew::detail {

template <class Element, int Nodes>
Eigen::Matrix<double, Nodes, Nodes> mass_of(Eigen::Matrix<double, 3, Nodes> const& x) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10. / 7)) / 3,
               outer = std::sqrt(5 + 2 * std::sqrt(10. / 7)) / 3, root = std::sqrt(70.);
  const double line[5] = {-outer, -inner, 0, inner, outer}, weights[5] = {(322 - 13 * root) / 900,
                                                                          (322 + 13 * root) / 900,
                                                                          128. / 225,
                                                                          (322 + 13 * root) / 900,
                                                                          (322 - 13 * root) / 900};
  Eigen::Matrix<double, Nodes, Nodes> mass;
  mass.setZero();
  for (int p = 0; p < 125; ++p) {
    std::array<double, 3> q{line[p % 5], line[p / 5 % 5], line[p / 25]};
    double weight = weights[p % 5] * weights[p / 5 % 5] * weights[p / 25];
    if constexpr (Element::collapsed) {
      const double u = (1 + q[0]) / 2, v = (1 + q[1]) / 2, w = (1 + q[2]) / 2;
      weight *= (1 - u) * (1 - u) * (1 - v) / 8;
      q = {u, v * (1 - u), w * (1 - u) * (1 - v)};
    }
    Eigen::Matrix<double, Nodes, 1> values;
    Eigen::Matrix<double, Nodes, 3> slopes;
    for (int i = 0; i < Nodes; ++i) {
      values[i] = Element::value(i, q);
      for (int k = 0; k < 3; ++k) slopes(i, k) = Element::slope(i, k, q);
    }
    const Eigen::Matrix3d jacobian = x * slopes;
    mass += weight * std::abs(jacobian.determinant()) * values * values.transpose();
  }
  return mass;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Eigen::Matrix<double, 10, 10> quadratic_mass(Eigen::Matrix<double, 3, 10> const& x) {
  return detail::mass_of<QuadraticTetrahedronShape>(x);
}
SINEW_ONCE Eigen::Matrix<double, 20, 20> quadratic_mass(Eigen::Matrix<double, 3, 20> const& x) {
  return detail::mass_of<QuadraticHexahedronShape>(x);
}
SINEW_ONCE Eigen::Matrix<double, 27, 27> quadratic_mass(Eigen::Matrix<double, 3, 27> const& x) {
  return detail::mass_of<TriquadraticHexahedronShape>(x);
}

}  // namespace sinew
#endif
