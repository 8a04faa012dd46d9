// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/lagrangian/sliding_lagrangian_constraint.hpp>

namespace sample {

template <class D, class E>
void prepare(SlidingLagrangianConstraint<D, E>& c, Random&) {
  c.axis_1 = (c.sliding_point + 1) % Body::n;
  c.axis_2 = (c.sliding_point + 11) % Body::n;
}

}  // namespace sample
