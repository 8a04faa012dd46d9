// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/rest_shape_springs.hpp>

namespace sample {

// of bodies that turn a tangent is proved at their rest positions, about all axes
template <class D>
void prepare(RestShapeSpringsForceField<D>& c, Random& random) {
  c.externalRestShape.clear();
  c.activeDirections.assign(std::size_t(D::size), true);
  if constexpr (D::rigid && D::spatial == 3)
    c.externalPoints.clear();
  else if constexpr (D::size > 1)
    c.activeDirections.back() = false;
  if constexpr (!(D::rigid && D::spatial == 3))
    for (int i = 0; i < Body::n; ++i) c.externalRestShape.push_back(coord<D>(random, 2));
}

}  // namespace sample
