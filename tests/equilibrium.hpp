// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "one_component.hpp"

#include <Eigen/QR>

namespace one {

/// The stiffness df/dx at the last force as a dense matrix.
template <class C>
Eigen::MatrixXd stiffness(C const& c, std::size_t points) {
  constexpr int n = C::DataTypes::size;
  const long dofs = long(points) * n;
  Eigen::MatrixXd k(dofs, dofs);
  for (long j = 0; j < dofs; ++j) {
    typename C::DataTypes::VecDeriv dx(points, C::DataTypes::Deriv::Zero());
    dx[std::size_t(j / n)][j % n] = 1;
    const auto df = product(c, dx, 1, 0);
    for (long i = 0; i < dofs; ++i) k(i, j) = df[std::size_t(i / n)][i % n];
  }
  return k;
}

/// Newton's method on force(x) + load = 0 over the degrees of freedom that are not held, 3 i + c of
/// coordinate c of point i. Directions without stiffness stay where they are. Returns the norm of the force
/// that is left.
template <class C>
double settle(C& c, Vec3d::VecCoord& x, std::vector<bool> const& held, Vec3d::VecDeriv const& load,
              int iterations) {
  const long dofs = 3 * long(x.size());
  Eigen::VectorXd residual(dofs);
  for (int iteration = 0;; ++iteration) {
    const auto f = force(c, x);
    for (long i = 0; i < dofs; ++i)
      residual[i] = held[std::size_t(i)] ? 0 : f[std::size_t(i / 3)][i % 3] + load[std::size_t(i / 3)][i % 3];
    if (iteration == iterations) return residual.norm();
    Eigen::MatrixXd k = stiffness(c, x.size());
    for (long i = 0; i < dofs; ++i)
      if (held[std::size_t(i)]) {
        k.row(i).setZero();
        k.col(i).setZero();
        k(i, i) = -1;
      }
    const Eigen::VectorXd dx = k.completeOrthogonalDecomposition().solve(-residual);
    for (long i = 0; i < dofs; ++i) x[std::size_t(i / 3)][i % 3] += dx[i];
  }
}

}  // namespace one
