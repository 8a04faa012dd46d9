// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/immersed_solid.hpp>

namespace sample {

// as after a step
template <class D>
void prepare(ImmersedSolid<D>& c, Random& random) {
  for (int i = 0; i < Body::n; ++i) c.body.forces.push_back(Eigen::Vector3d(random(), random(), random()));
}

}  // namespace sample
