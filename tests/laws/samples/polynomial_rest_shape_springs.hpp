// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/polynomial_rest_shape_springs.hpp>

namespace sample {

template <class D>
void prepare(PolynomialRestShapeSpringsForceField<D>& c, Random& random) {
  c.polynomialDegree = {3}, c.polynomialStiffness = {3, 1, 2};
  c.externalRestShape.clear(), c.externalPoints.clear();
  for (std::size_t i = 0; i < c.points.size(); ++i) c.externalRestShape.push_back(coord<D>(random, 2));
}

}  // namespace sample
