// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/surface_pressure.hpp>

namespace sample {

// a pressure is proved on a closed surface, where it has an energy, all of that of the body; in the middle of
// a pulse
template <class... A>
void prepare(SurfacePressureForceField<A...>& c, Random& random) {
  c.triangleIndices.clear(), c.quadIndices.clear();
  c.min.reset(), c.max.reset();
  c.pulse = random(1, 2);
}

}  // namespace sample
