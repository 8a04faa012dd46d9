// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/fixed_plane.hpp>

namespace sample {

template <class... A>
void prepare(FixedPlaneConstraint<A...>& c, Random&) {
  c.dmin = 0, c.dmax = 1;
}

}  // namespace sample
