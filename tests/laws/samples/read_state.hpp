// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/control/read_state.hpp>

namespace sample {

// all points over the times 0 to 2, on a way of their own
template <class D>
void prepare(ReadState<D>& c, Random& random) {
  c.keyTimes = {0, 1, 2};
  c.keyPositions.clear(), c.keyVelocities.clear();
  for (int i = 0; i < 3 * Body::n; ++i) c.keyPositions.push_back(coord<D>(random));
  c.shift = 0.1;
  if constexpr (D::spatial != 3) c.scalePos = 1, c.rotation.setZero(), c.translation.setZero();
}

}  // namespace sample
