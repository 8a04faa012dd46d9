// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/attach.hpp>

namespace sample {

// some points attached to others, one of them to three
template <class... A>
void prepare(AttachProjectiveConstraint<A...>& c, Random&) {
  c.indices1 = {0, 1, 2, 2, 9}, c.indices2 = {10, 13, 11, 20, 15}, c.constraintFactor = {1, 1, 1, 1, 0};
}

}  // namespace sample
