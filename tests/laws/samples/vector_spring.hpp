// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/repulsive_spring.hpp>
#include <sinew/force/vector_spring.hpp>

namespace sample {

template <class... A>
void prepare(VectorSpringForceField<A...>& c, Random&) {
  for (auto& s : c.springs)
    if (s.first == s.second) s.second = (s.first + 1) % Body::n;
}
template <class... A>
void prepare(RepulsiveSpringForceField<A...>& c, Random&) {
  for (auto& s : c.springs) {
    if (s.first == s.second) s.second = (s.first + 1) % Body::n;
    s.length = 5;  // longer than they are
  }
  join_two_points(c.springsIndices1, c.springsIndices2);
}

}  // namespace sample
