// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

namespace sinew {

/// [a]x, with which [a]x b = a x b.
template <class Real>
Mat<Real, 3> cross_matrix(Vec<Real, 3> const& a) {
  Mat<Real, 3> m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

}  // namespace sinew
