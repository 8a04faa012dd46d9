// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>
#include <sinew/fluid/viscosity_loops.hpp>

namespace sinew::fluid {

/// Viscosity of an incompressible fluid, implicit in time (backward Euler):
///   (1 - nu dt Laplacian) u = u*
/// for each component, by conjugate gradients with the inverse of the diagonal. Fluid sticks to solids or
/// slips along them, whose surface lies in the middle between faces where it is along these; a free surface
/// has no gradient.
template <class Real, int N, class Loops = HostLoops>
class Viscosity {
 public:
  using Velocity = StaggeredVelocity<Real, N, Loops>;

  void init(CellGrid<N> const& grid) {
    for (auto* field : {&right_, &residual_, &direction_, &product_, &inverse_})
      Loops::assign(*field, grid.size, Real(0));
    numbers_.init(grid);
  }

  /// u over a step with `number` = nu dt / h^2. Returns how many iterations all components took.
  int apply(Velocity& u, Real number, double tolerance, int maxIterations, Loops const& loops) {
    int iterations = 0;
    for (std::size_t c = 0; c < axes<N>; ++c)
      iterations += solve(u, c, number, tolerance, maxIterations, loops);
    return iterations;
  }

 private:
  typename Loops::template Array<Real> right_{}, residual_{}, direction_{}, product_{}, inverse_{};
  typename Loops::Numbers numbers_{};
  // which number is what
  static constexpr std::size_t squares = 0, rz = 1, before = 2, curvature = 3;

  int solve(Velocity& u, std::size_t c, Real number, double tolerance, int maxIterations,
            Loops const& loops) {
    CellGrid<N> const& grid = u.grid;
    const ViscousFaces<Real, N> faces{u.view(),
                                      c,
                                      number,
                                      entries(u.value[c]),
                                      entries(right_),
                                      entries(residual_),
                                      entries(direction_),
                                      entries(product_),
                                      entries(inverse_)};
    double* const at = numbers_.at(0);
    auto norm = [&](Real const* field) {
      loops.sum(grid, numbers_, squares, Product<Real>{field, field});
      return std::sqrt(numbers_.read(squares));
    };
    loops.wrap(grid, faces.x);
    loops.cells(grid, ViscousStart<Real, N>{faces});
    const double wanted = tolerance * norm(faces.right);
    loops.cells(grid, ViscousMultiply<Real, N>{faces, faces.x});
    loops.cells(grid, ViscousResidual<Real, N>{faces});
    int iteration = 0;
    for (; iteration < maxIterations && norm(faces.residual) > wanted; ++iteration) {
      loops.sum(grid, numbers_, rz, ViscousWeighted<Real, N>{faces});
      loops.cells(grid, ViscousDirection<Real, N>{faces, at + rz, at + before, iteration > 0});
      loops.once(CopyNumber{at + before, at + rz});
      loops.wrap(grid, faces.direction);
      loops.cells(grid, ViscousMultiply<Real, N>{faces, faces.direction});
      loops.sum(grid, numbers_, curvature, Product<Real>{faces.direction, faces.product});
      loops.cells(grid, ViscousUpdate<Real, N>{faces, at + rz, at + curvature});
    }
    loops.wrap(grid, faces.x);
    return iteration;
  }
};

}  // namespace sinew::fluid
