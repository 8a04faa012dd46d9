// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/subset_multi_mapping.hpp>

namespace sample {

// points of three parents, of nine points each
template <class... A>
void prepare(SubsetMultiMapping<A...>& c, Random& random) {
  c.indexPairs.resize(7);
  for (std::size_t i = 0; i < 7; ++i) c.indexPairs[i] = {int(i) % 3, random.index(9)};
}

}  // namespace sample
