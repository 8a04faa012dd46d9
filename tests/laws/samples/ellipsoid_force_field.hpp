// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/ellipsoid_force_field.hpp>

namespace sample {

// a sphere, which has an energy; others are tested by tests/force/ellipsoid_force_field.cpp
template <class D>
void prepare(EllipsoidForceField<D>& c, Random& random) {
  c.vradius.setConstant(random(3, 4));
}

}  // namespace sample
