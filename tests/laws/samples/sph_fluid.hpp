// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/sph_fluid.hpp>

namespace sample {

// particles with neighbours
template <class D>
void prepare(SPHFluidForceField<D>& c, Random&) {
  c.radius = 2;
  c.kernelType = c.pressureType = 1;
  c.viscosityType = c.surfaceTensionType = 2;
}

}  // namespace sample
