// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/affine_movement.hpp>

namespace sample {

template <class... A>
void prepare(AffineMovementConstraint<A...>& c, Random&) {
  c.beginConstraintTime = 0, c.endConstraintTime = 2;
}

}  // namespace sample
