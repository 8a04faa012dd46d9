// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/lagrangian/stopper_lagrangian_constraint.hpp>

#include <utility>

namespace sample {

template <class D>
void prepare(StopperLagrangianConstraint<D>& c, Random&) {
  if (c.min > c.max) std::swap(c.min, c.max);
}

}  // namespace sample
