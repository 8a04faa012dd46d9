// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/patch_test_movement.hpp>

namespace sample {

// the corners of a box around all of the body
template <class D>
void prepare(PatchTestMovementProjectiveConstraint<D>& c, Random& random) {
  c.beginConstraintTime = 0, c.endConstraintTime = 2;
  c.constrainedPoints.clear();
  c.cornerPoints = {D::zero(), D::zero()};
  typename D::Deriv across = D::Deriv::Zero();
  across.template head<3>().setConstant(3);
  D::increment(c.cornerPoints[1], across);
  c.cornerMovements = derivs<D>(8, random);
}

}  // namespace sample
