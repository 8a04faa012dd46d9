// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/diagonal_velocity_damping.hpp>

namespace sample {

template <class D>
void prepare(DiagonalVelocityDampingForceField<D>& c, Random& random) {
  c.dampingCoefficient.assign(3, D::Deriv::Zero());
  for (auto& one : c.dampingCoefficient) one = vector<typename D::Deriv>(random).cwiseAbs();
}

}  // namespace sample
