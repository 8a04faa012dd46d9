// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/particle_source.hpp>

namespace sample {

// room for points that come, of which some have come
template <class D>
void prepare(ParticleSource<D>& c, Random&) {
  c.capacity = 2 * Body::n;
  c.radius = c.radius.cwiseAbs();
  c.start = 0, c.stop = 1;
  c.held = {3, 4, 20};
}

}  // namespace sample
