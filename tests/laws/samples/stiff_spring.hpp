// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/stiff_spring.hpp>

namespace sample {

template <class... A>
void prepare(StiffSpringForceField<A...>& c, Random&) {
  for (auto& s : c.springs)
    if (s.first == s.second) s.second = (s.first + 1) % Body::n;
  join_two_points(c.springsIndices1, c.springsIndices2);
}

}  // namespace sample
