// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/distance_multi_mapping.hpp>

namespace sample {

// points of three parents, of nine points each, two of one among them; edges of laws::Joined
template <class... A>
void prepare(DistanceMultiMapping<A...>& c, Random&) {
  c.indexPairs = {{0, 1}, {1, 4}, {2, 0}, {0, 7}, {2, 8}, {1, 3}, {1, 8}};
  c.restLengths.clear();  // those of the rest positions
}
template <class... A>
constexpr std::size_t child_points(DistanceMultiMapping<A...> const&) {
  return 0;
}
template <class... A>
constexpr bool stabilizes(DistanceMultiMapping<A...> const&) {
  return true;
}

}  // namespace sample
