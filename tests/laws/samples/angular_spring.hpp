// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/angular_spring.hpp>

namespace sample {

// bodies that the one before them holds
template <class... A>
void prepare(AngularSpringForceField<A...>& c, Random&) {
  for (int& i : c.indices) i = std::max(i, 1);
}

}  // namespace sample
