// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>

#include <limits>

namespace sinew {

/// to = d^-1 by elimination after Gauss and Jordan; false unless d is positive definite, by more than
/// rounding.
template <class Block>
SINEW_HD bool invert_definite(Block d, Block& to) {
  using Real = typename Block::Scalar;
  constexpr int n = Block::RowsAtCompileTime;
  Real largest = 0;
  for (int c = 0; c < n; ++c) largest = d(c, c) > largest ? d(c, c) : largest;
  const Real threshold = largest * 32 * std::numeric_limits<Real>::epsilon();
  to.setIdentity();
  for (int c = 0; c < n; ++c) {
    const Real pivot = d(c, c);
    if (!(pivot > threshold && pivot <= std::numeric_limits<Real>::max())) return false;
    d.row(c) /= pivot;
    to.row(c) /= pivot;
    for (int r = 0; r < n; ++r)
      if (const Real f = d(r, c); r != c && f != 0) {
        d.row(r) -= f * d.row(c);
        to.row(r) -= f * to.row(c);
      }
  }
  return true;
}

/// to = |diagonal of d|^-1, with 1 where that is none: positive definite whatever d is.
template <class Block>
SINEW_HD void invert_diagonal(Block const& d, Block& to) {
  using Real = typename Block::Scalar;
  to.setZero();
  for (int r = 0; r < int(Block::RowsAtCompileTime); ++r) {
    const Real size = d(r, r) < 0 ? -d(r, r) : d(r, r);
    to(r, r) = size > 0 && size <= std::numeric_limits<Real>::max() ? 1 / size : Real(1);
  }
}

}  // namespace sinew
