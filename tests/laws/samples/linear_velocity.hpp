// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/linear_velocity.hpp>

namespace sample {

// over the times 0 to 2; a body turns about one axis, as its orientation has it
template <class... A>
void prepare(LinearVelocityConstraint<A...>& c, Random& random) {
  using D = typename LinearVelocityConstraint<A...>::DataTypes;
  c.keyTimes = {0, 1, 2};
  fill(c.velocities, random);
  if constexpr (D::rigid && D::spatial == 3)
    for (std::size_t k = 1; k < 3; ++k)
      c.velocities[k].template tail<3>() = c.velocities[0].template tail<3>() * typename D::Real(k + 1);
  c.coordinates.assign(1, 0);
}

}  // namespace sample
