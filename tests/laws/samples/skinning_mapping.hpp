// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/skinning_mapping.hpp>

namespace sample {

// the nearest frames, with the weights that follow
template <class... A>
void prepare(SkinningMapping<A...>& c, Random&) {
  c.nbRef = {3};
  c.indices.clear(), c.weight.clear(), c.initPos.clear();
}

}  // namespace sample
