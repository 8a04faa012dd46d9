// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/virtual_coupling.hpp>

namespace sample {

// an energy is that of a body at rest, beside a target at rest; of bodies that turn, a tangent is proved at
// their rest positions, which are then the target
template <class... A>
void prepare(VirtualCoupling<A...>& c, Random&) {
  c.targetVelocity.clear();
  if constexpr (VirtualCoupling<A...>::rotates) c.target.clear();
}

}  // namespace sample
