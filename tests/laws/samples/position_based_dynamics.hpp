// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/position_based_dynamics.hpp>

namespace sample {

// takes no motion away: it adds one at the end of a step
template <class D>
constexpr bool has_laws(PositionBasedDynamicsProjectiveConstraint<D> const&) {
  return false;
}

}  // namespace sample
