// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/rigid_mapping.hpp>

namespace sample {

template <class I, class O>
void prepare(RigidMapping<I, O>& c, Random&) {
  c.initialPoints.clear();  // the points are those of the child
}

}  // namespace sample
