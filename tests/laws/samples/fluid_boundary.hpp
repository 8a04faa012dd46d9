// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/fluid_boundary.hpp>

namespace sample {

// as after a step
template <class D>
void prepare(FluidBoundary<D>& c, Random& random) {
  using Real = typename D::Real;
  for (int i = 0; i < Body::n; ++i)
    c.forces.push_back(typename D::Deriv(Real(random()), Real(random()), Real(random())));
}

}  // namespace sample
