// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace sinew {

// Stiffness of flat triangular shell elements in their own plane. Corners are in counter-clockwise
// order.

template <class Real>
using PlaneTriangle = std::array<Vec<Real, 2>, 3>;

/// Plane stress: strain (xx, yy, 2 xy) to stress.
template <class Real>
Mat<Real, 3> plane_stress(Real E, Real nu) {
  Mat<Real, 3> c;
  c << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return E / (1 - nu * nu) * c;
}

/// Membrane with drilling freedoms over (u, v, theta) of each corner: the optimal triangle OPT of Felippa
/// 2003, "A study of optimal membrane triangles with drilling freedoms" (ANDES: Alvin, de la Fuente, Haugen,
/// Felippa 1992). A part K_b of constant stress, which passes the patch test, and a part K_h of higher order
/// that bends in the plane as beams do and holds the drilling rotations.
template <class Real>
Mat<Real, 9> membrane_stiffness(PlaneTriangle<Real> const& p, Real E, Real nu, Real thickness) {
  const Mat<Real, 3> material = plane_stress(E, nu);
  auto x = [&](int i, int j) { return p[std::size_t(i)][0] - p[std::size_t(j)][0]; };
  auto y = [&](int i, int j) { return p[std::size_t(i)][1] - p[std::size_t(j)][1]; };
  const Real area = (x(1, 0) * y(2, 0) - x(2, 0) * y(1, 0)) / 2;

  // forces of a constant stress, lumped at the corners
  Mat<Real, 9, 3> lump;
  const Real a = 1.5;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    lump.row(3 * i) << y(j, k), 0, x(k, j);
    lump.row(3 * i + 1) << 0, x(k, j), y(j, k);
    lump.row(3 * i + 2) << a / 6 * y(j, k) * (y(i, k) - y(j, i)), a / 6 * x(k, j) * (x(k, i) - x(i, j)),
        a / 3 * (x(k, i) * y(i, k) - x(i, j) * y(j, i));
  }
  lump *= thickness / 2;
  Mat<Real, 9> stiffness = lump * material * lump.transpose() / (area * thickness);

  // corner rotations against that of the element as a whole
  Mat<Real, 3, 9> hierarchical = Mat<Real, 3, 9>::Zero();
  for (int i = 0; i < 3; ++i) {
    hierarchical(i, 3 * i + 2) = 1;
    for (int c = 0; c < 3; ++c) {
      const int j = (c + 1) % 3, k = (c + 2) % 3;
      hierarchical(i, 3 * c) = x(k, j) / (4 * area);
      hierarchical(i, 3 * c + 1) = y(k, j) / (4 * area);
    }
  }
  // strains along the sides 12, 23, 31 to those in the axes
  const Real l[3] = {x(1, 0) * x(1, 0) + y(1, 0) * y(1, 0),
                     x(2, 1) * x(2, 1) + y(2, 1) * y(2, 1),
                     x(0, 2) * x(0, 2) + y(0, 2) * y(0, 2)};
  Mat<Real, 3> natural;
  for (int s = 0; s < 3; ++s) {
    // side s joins corners s and s + 1; n is the corner opposite
    const int i = s, j = (s + 1) % 3, n = (s + 2) % 3;
    natural(0, s) = y(j, n) * y(i, n) * l[s];
    natural(1, s) = x(j, n) * x(i, n) * l[s];
    natural(2, s) = (y(j, n) * x(n, i) + x(n, j) * y(i, n)) * l[s];
  }
  natural /= 4 * area * area;
  const Mat<Real, 3> naturalMaterial = natural.transpose() * material * natural;
  // natural strains at the corners by the hierarchical rotations
  Mat<Real, 3> q[3];
  const Real b[9] = {1, 2, 1, 0, 1, -1, -1, -1, -2};
  const int order[3][9] = {
      {0, 1, 2, 3, 4, 5, 6, 7, 8}, {8, 6, 7, 2, 0, 1, 5, 3, 4}, {4, 5, 3, 7, 8, 6, 1, 2, 0}};
  for (int n = 0; n < 3; ++n)
    for (int s = 0; s < 3; ++s)
      for (int c = 0; c < 3; ++c) q[n](s, c) = 2 * area / 3 * b[order[n][3 * s + c]] / l[s];
  Mat<Real, 3> rotations = Mat<Real, 3>::Zero();
  for (int n = 0; n < 3; ++n) {
    const Mat<Real, 3> middle = (q[n] + q[(n + 1) % 3]) / 2;
    rotations += area * thickness * middle.transpose() * naturalMaterial * middle;
  }
  const Real beta = std::max(Real(0.5) * (1 - 4 * nu * nu), Real(0.01));
  return stiffness + 0.75 * beta * hierarchical.transpose() * rotations * hierarchical;
}

/// Bending over the rotations (theta_x, theta_y) of each corner, corners without deflection: the discrete
/// Kirchhoff triangle (Batoz, Bathe & Ho 1980). The rotations (theta_y, -theta_x) of the normal are
/// quadratic; in the middle of a side of direction s they are (I/2 - 3/4 s s') times the sum of those at its
/// ends, which makes shear vanish along the sides.
template <class Real>
Mat<Real, 6> plate_stiffness(PlaneTriangle<Real> const& p, Real E, Real nu, Real thickness) {
  const Mat<Real, 3> material = thickness * thickness * thickness / 12 * plane_stress(E, nu);
  Mat<Real, 2> edges;
  edges << p[1] - p[0], p[2] - p[0];
  const Real area = edges.determinant() / 2;
  Mat<Real, 2, 3> gradient;  // of the linear shape functions
  gradient.template rightCols<2>() = edges.inverse().transpose();
  gradient.col(0) = -gradient.col(1) - gradient.col(2);

  Mat<Real, 6> stiffness = Mat<Real, 6>::Zero();
  for (int m = 0; m < 3; ++m) {
    // the middles of the sides integrate quadratic functions exactly
    Vec<Real, 3> at = Vec<Real, 3>::Constant(0.5);
    at[m] = 0;
    Mat<Real, 3, 6> curvature = Mat<Real, 3, 6>::Zero();
    auto add = [&](int corner, Vec<Real, 2> const& slope, Mat<Real, 2> const& by) {
      // (theta_x, theta_y) -> rotation of the normal -> its gradient
      Mat<Real, 2> normal;
      normal << 0, 1, -1, 0;
      const Mat<Real, 2> r = by * normal;
      curvature.row(0).template segment<2>(2 * corner) += slope[0] * r.row(0);
      curvature.row(1).template segment<2>(2 * corner) += slope[1] * r.row(1);
      curvature.row(2).template segment<2>(2 * corner) += slope[1] * r.row(0) + slope[0] * r.row(1);
    };
    for (int i = 0; i < 3; ++i) {
      add(i, (4 * at[i] - 1) * gradient.col(i), Mat<Real, 2>::Identity());
      const int j = (i + 1) % 3;
      const Vec<Real, 2> side = (p[std::size_t(j)] - p[std::size_t(i)]).normalized();
      const Vec<Real, 2> slope = 4 * (at[i] * gradient.col(j) + at[j] * gradient.col(i));
      const Mat<Real, 2> middle = 0.5 * Mat<Real, 2>::Identity() - 0.75 * side * side.transpose();
      add(i, slope, middle);
      add(j, slope, middle);
    }
    stiffness += area / 3 * curvature.transpose() * material * curvature;
  }
  return stiffness;
}

}  // namespace sinew
