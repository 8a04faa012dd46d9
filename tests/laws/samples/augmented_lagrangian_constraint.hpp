// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "unilateral_lagrangian_constraint.hpp"

#include <sinew/lagrangian/augmented_lagrangian_constraint.hpp>

namespace sample {

template <class D, class E>
void prepare(AugmentedLagrangianConstraint<D, E>& c, Random&) {
  prepare_contacts(c);
}

}  // namespace sample
