// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/fixed_rotation.hpp>

namespace sample {

// at least one axis is held
template <class D, class F>
void for_each_choice(FixedRotationConstraint<D>& c, Random&, F&& f) {
  for (int axes = 1; axes < 8; ++axes) {
    c.fixedXRotation = axes & 1, c.fixedYRotation = axes & 2, c.fixedZRotation = axes & 4;
    f(c);
  }
}

}  // namespace sample
