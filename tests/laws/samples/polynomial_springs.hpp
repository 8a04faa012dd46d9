// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/polynomial_springs.hpp>

namespace sample {

template <class... A>
void prepare(PolynomialSpringsForceField<A...>& c, Random&) {
  c.polynomialDegree = {3}, c.polynomialStiffness = {3, 1, 2};
  join_two_points(c.firstObjectPoints, c.secondObjectPoints);
}

}  // namespace sample
