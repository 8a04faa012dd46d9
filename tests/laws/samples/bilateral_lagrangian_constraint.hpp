// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/lagrangian/bilateral_lagrangian_constraint.hpp>

namespace sample {

template <class D, class E>
void prepare(BilateralLagrangianConstraint<D, E>& c, Random&) {
  join_two_points(c.first_point, c.second_point);
  c.load = 1;  // else d is a part of what the Jacobian is of
}

}  // namespace sample
