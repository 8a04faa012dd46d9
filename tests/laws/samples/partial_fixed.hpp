// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/partial_fixed.hpp>

namespace sample {

template <class... A>
void prepare(PartialFixedConstraint<A...>& c, Random&) {
  c.fixedDirections.back() = c.fixedDirections.size() == 1;
}

}  // namespace sample
