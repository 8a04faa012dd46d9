// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/element_driver.hpp>

#include <cstddef>
#include <vector>

// What penalty forces on all points of a state have in common: those of planes, spheres, cones, ellipsoids.
namespace sinew {

/// An element of the same rest for each of n points, in their order.
template <class Driver>
void init_each_point(Driver& driver, std::size_t n, typename Driver::Rest const& rest) {
  std::vector<typename Driver::Indices> points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = {int(i)};
  driver.init(points, std::vector<typename Driver::Rest>(n, rest));
}

/// Whether a point at a depth is pushed: inside, or anywhere where the force is bilateral.
template <class Real>
SINEW_INLINE auto is_touched(Real const& depth, bool bilateral) {
  auto acts = depth > Real(0);
  if (bilateral) acts = depth == depth;
  return acts;
}

/// df = block dx of a force on the place of a point, which has no torque.
template <class D>
SINEW_INLINE void push_place(Mat<typename D::Real, D::size> const& block, typename D::Deriv const& dx,
                             typename D::Deriv& df) {
  using Real = typename D::Real;
  for (int r = 0; r < D::size; ++r) {
    df[r] = Real(0);
    for (int c = 0; c < (r < D::spatial ? D::spatial : 0); ++c) df[r] += block(r, c) * dx[c];
  }
}

}  // namespace sinew
