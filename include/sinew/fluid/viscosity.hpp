// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>

namespace sinew::fluid {

/// Viscosity of an incompressible fluid, implicit in time (backward Euler):
///   (1 - nu dt Laplacian) u = u*
/// for each component, by conjugate gradients with the inverse of the diagonal. Fluid sticks to solids or
/// slips along them, whose surface lies in the middle between faces where it is along these; a free surface
/// has no gradient.
template <class Real, int N>
class Viscosity {
 public:
  void init(CellGrid<N> const& grid) {
    for (auto* field : {&right_, &residual_, &direction_, &product_, &inverse_})
      field->assign(grid.size, Real(0));
    sums_.assign(grid.rows(), 0.0);
  }

  /// u over a step with `number` = nu dt / h^2. Returns how many iterations all components took.
  int apply(StaggeredVelocity<Real, N>& u, Real number, double tolerance, int maxIterations,
            SomeWorkers workers) {
    int iterations = 0;
    for (std::size_t c = 0; c < axes<N>; ++c)
      iterations += solve(u, c, number, tolerance, maxIterations, workers);
    return iterations;
  }

 private:
  std::vector<Real> right_{}, residual_{}, direction_{}, product_{}, inverse_{};
  std::vector<double> sums_{};

  // coupled(neighbour) for faces that move, held(velocity, factor) for what holds the face i of axis c
  template <class Coupled, class Held>
  static void around(StaggeredVelocity<Real, N> const& u, std::size_t c, std::ptrdiff_t i, Coupled&& coupled,
                     Held&& held) {
    const std::ptrdiff_t t = u.grid.stride[c];
    for (std::size_t d = 0; d < axes<N>; ++d)
      for (const int sign : {-1, 1}) {
        const std::ptrdiff_t j = i + sign * u.grid.stride[d];
        const auto k = std::size_t(j);
        switch (u.kind[c][k]) {
          case FaceKind::fluid:
            coupled(j);
            break;
          case FaceKind::wall:
            held(u.solid[c][k], Real(1));
            break;
          case FaceKind::inside:
            if (u.cell[k] == CellKind::solid && u.cell[std::size_t(j - t)] == CellKind::solid && !u.slips)
              held(u.solid[c][k], Real(2));
            break;
        }
      }
  }

  int solve(StaggeredVelocity<Real, N>& u, std::size_t c, Real number, double tolerance, int maxIterations,
            SomeWorkers workers) {
    CellGrid<N> const& grid = u.grid;
    auto& x = u.value[c];
    auto at = [](std::ptrdiff_t i) { return std::size_t(i); };
    auto dot = [&](std::vector<Real> const& a, std::vector<Real> const& b) {
      return grid.sum(workers, sums_, [&](std::ptrdiff_t i) { return double(a[at(i)]) * double(b[at(i)]); });
    };
    auto multiply = [&](std::vector<Real> const& v, std::vector<Real>& out) {
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        if (u.kind[c][at(i)] != FaceKind::fluid) return;
        Real sum = v[at(i)] / inverse_[at(i)];
        around(
            u, c, i, [&](std::ptrdiff_t j) { sum -= number * v[at(j)]; }, [](Real, Real) {});
        out[at(i)] = sum;
      });
    };
    grid.wrap(std::span<Real>(x));
    grid.forCells(workers, [&](std::ptrdiff_t i) {
      right_[at(i)] = residual_[at(i)] = direction_[at(i)] = product_[at(i)] = 0;
      if (u.kind[c][at(i)] != FaceKind::fluid) return;
      Real diagonal = 1, right = x[at(i)];
      around(
          u,
          c,
          i,
          [&](std::ptrdiff_t) { diagonal += number; },
          [&](Real velocity, Real factor) {
            diagonal += factor * number;
            right += factor * number * velocity;
          });
      inverse_[at(i)] = 1 / diagonal;
      right_[at(i)] = right;
    });
    const double wanted = tolerance * std::sqrt(dot(right_, right_));
    multiply(x, product_);
    grid.forCells(workers, [&](std::ptrdiff_t i) { residual_[at(i)] = right_[at(i)] - product_[at(i)]; });
    double rz = 0;
    int iteration = 0;
    for (; iteration < maxIterations && std::sqrt(dot(residual_, residual_)) > wanted; ++iteration) {
      const double now = grid.sum(workers, sums_, [&](std::ptrdiff_t i) {
        return u.kind[c][at(i)] == FaceKind::fluid
                   ? double(residual_[at(i)]) * double(residual_[at(i)]) * double(inverse_[at(i)])
                   : 0.0;
      });
      const Real beta = iteration > 0 ? Real(now / rz) : Real(0);
      rz = now;
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        if (u.kind[c][at(i)] == FaceKind::fluid)
          direction_[at(i)] = inverse_[at(i)] * residual_[at(i)] + beta * direction_[at(i)];
      });
      grid.wrap(std::span<Real>(direction_));
      multiply(direction_, product_);
      const Real alpha = Real(rz / dot(direction_, product_));
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        if (u.kind[c][at(i)] != FaceKind::fluid) return;
        x[at(i)] += alpha * direction_[at(i)];
        residual_[at(i)] -= alpha * product_[at(i)];
      });
    }
    grid.wrap(std::span<Real>(x));
    return iteration;
  }
};

}  // namespace sinew::fluid
