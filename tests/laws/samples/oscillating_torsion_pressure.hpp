// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/oscillating_torsion_pressure.hpp>

namespace sample {

// the first triangles of the body
template <class D>
void prepare(OscillatingTorsionPressureForceField<D>& c, Random&) {
  c.triangleList = {0, 1, 2, 3, 4};
  c.dmin = 0, c.dmax = 1;
}

}  // namespace sample
