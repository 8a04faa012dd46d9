// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>
#include <sinew/fluid/viscosity_loops.hpp>

namespace sinew::fluid {

/// Viscosity of an incompressible fluid, implicit in time (backward Euler):
///   (1 - nu dt Laplacian) u = u*
/// by conjugate gradients with the inverse of the diagonal. Fluid sticks to solids or slips along them, whose
/// surface lies in the middle between faces where it is along these; a free surface has no gradient. `more`
/// adds what holds the fluid besides (WallDrag).
template <class Real, int N, class Loops = HostLoops>
class Viscosity {
 public:
  using Velocity = StaggeredVelocity<Real, N, Loops>;
  using Fields = Each<typename Loops::template Array<Real>, N>;

  /// Nothing else holds the fluid.
  struct NoMore {
    void start(Velocity const&, Fields&, Fields&) const {}
    void respond(Fields const&, Fields&) const {}
  };

  void init(CellGrid<N> const& grid) {
    for (auto* fields : {&right_, &residual_, &direction_, &product_, &inverse_})
      for (auto& field : *fields) Loops::assign(field, grid.size, Real(0));
    numbers_.init(grid);
  }

  /// u over a step with `number` = nu dt / h^2. Returns how many iterations it took.
  template <class More = NoMore>
  int apply(Velocity& u, Real number, double tolerance, int maxIterations, Loops const& loops,
            More const& more = {}) {
    CellGrid<N> const& grid = u.grid;
    Each<ViscousFaces<Real, N>, N> faces{};
    for (std::size_t c = 0; c < axes<N>; ++c)
      faces[c] = {u.view(),
                  c,
                  number,
                  entries(u.value[c]),
                  entries(right_[c]),
                  entries(residual_[c]),
                  entries(direction_[c]),
                  entries(product_[c]),
                  entries(inverse_[c])};
    double* const at = numbers_.at(0);
    // number k = the sum of what term(faces) finds over all components
    auto sum = [&](std::size_t k, auto&& term) {
      for (std::size_t c = 0; c < axes<N>; ++c) loops.sum(grid, numbers_, parts + c, term(faces[c]));
      loops.once(SumOfNumbers<N>{at + k, at + parts});
    };
    auto norm = [&](auto&& of) {
      sum(squares, [&](auto const& f) { return Product<Real>{of(f), of(f)}; });
      return std::sqrt(numbers_.read(squares));
    };
    auto multiply = [&](Fields const& from, auto&& of) {
      for (auto const& f : faces) {
        loops.wrap(grid, of(f));
        loops.cells(grid, ViscousMultiply<Real, N>{f, of(f)});
      }
      more.respond(from, product_);
    };
    for (auto const& f : faces) loops.cells(grid, ViscousStart<Real, N>{f});
    more.start(u, inverse_, right_);
    const double wanted = tolerance * norm([](auto const& f) { return f.right; });
    multiply(u.value, [](auto const& f) { return f.x; });
    for (auto const& f : faces) loops.cells(grid, ViscousResidual<Real, N>{f});
    int iteration = 0;
    for (; iteration < maxIterations && norm([](auto const& f) { return f.residual; }) > wanted;
         ++iteration) {
      sum(rz, [](auto const& f) { return ViscousWeighted<Real, N>{f}; });
      for (auto const& f : faces)
        loops.cells(grid, ViscousDirection<Real, N>{f, at + rz, at + before, iteration > 0});
      loops.once(CopyNumber{at + before, at + rz});
      multiply(direction_, [](auto const& f) { return f.direction; });
      sum(curvature, [](auto const& f) { return Product<Real>{f.direction, f.product}; });
      for (auto const& f : faces) loops.cells(grid, ViscousUpdate<Real, N>{f, at + rz, at + curvature});
    }
    for (auto const& f : faces) loops.wrap(grid, f.x);
    return iteration;
  }

 private:
  Fields right_{}, residual_{}, direction_{}, product_{}, inverse_{};
  typename Loops::Numbers numbers_{};
  // which number is what
  static constexpr std::size_t squares = 0, rz = 1, before = 2, curvature = 3, parts = 4;
};

}  // namespace sinew::fluid
