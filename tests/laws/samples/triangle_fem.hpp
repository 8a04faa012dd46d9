// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/triangle_fem.hpp>

namespace sample {

// the tangent holds the frames of elements, which counts where they are in tension at rest: that is tested by
// tests/force/triangle_fem.cpp
template <class... A>
void prepare(TriangleFEMForceField<A...>& c, Random&) {
  c.restScale = 1;
}

}  // namespace sample
