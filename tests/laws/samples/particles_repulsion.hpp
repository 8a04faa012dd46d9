// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/particles_repulsion.hpp>

namespace sample {

// points with neighbours where they are shaken, and none at rest, where only the derivative along pairs is
// exact
template <class D>
void prepare(ParticlesRepulsionForceField<D>& c, Random&) {
  c.distance = 0.8;
  c.damping = 0;
}

}  // namespace sample
