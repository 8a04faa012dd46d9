// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/particle_sink.hpp>

namespace sample {

// takes points away, and velocities at the end of a step, but leaves motions as they are
template <class D>
constexpr bool has_laws(ParticleSink<D> const&) {
  return false;
}

}  // namespace sample
