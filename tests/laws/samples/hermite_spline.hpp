// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/hermite_spline.hpp>

namespace sample {

template <class... A>
void prepare(HermiteSplineConstraint<A...>& c, Random&) {
  c.beginTime = 0, c.endTime = 2;
}

}  // namespace sample
