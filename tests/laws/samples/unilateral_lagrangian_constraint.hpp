// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/lagrangian/unilateral_lagrangian_constraint.hpp>

namespace sample {

/// Contacts of points that touch from the start of the step on: of others a part of the slide counts.
template <class C>
void prepare_contacts(C& c) {
  join_two_points(c.first_point, c.second_point);
  c.contactDistance = {10};  // the body is smaller
}

template <class D, class E>
void prepare(UnilateralLagrangianConstraint<D, E>& c, Random&) {
  prepare_contacts(c);
}

}  // namespace sample
