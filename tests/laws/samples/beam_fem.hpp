// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/beam_fem.hpp>

namespace sample {

template <class... A>
void prepare(BeamFEMForceField<A...>& c, Random&) {
  c.radiusInner = c.radius / 2;
}

}  // namespace sample
