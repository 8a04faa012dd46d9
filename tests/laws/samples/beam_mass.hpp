// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mass/beam_mass.hpp>

namespace sample {

template <class... A>
void prepare(BeamMass<A...>& c, Random&) {
  c.radiusInner = c.radius / 2;
}

}  // namespace sample
