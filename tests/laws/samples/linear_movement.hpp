// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/linear_movement.hpp>

namespace sample {

// over the times 0 to 2
template <class... A>
void prepare(LinearMovementConstraint<A...>& c, Random& random) {
  c.keyTimes = {0, 1, 2};
  fill(c.movements, random);
}

}  // namespace sample
