// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/fast_triangular_bending_springs.hpp>

namespace sample {

template <class... A>
void prepare(FastTriangularBendingSprings<A...>& c, Random&) {
  c.minDistValidity = 0;
}

}  // namespace sample
