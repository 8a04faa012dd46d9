// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/distance_mapping.hpp>

namespace sample {

template <class... A>
void prepare(DistanceMapping<A...>& c, Random&) {
  c.restLengths.clear();  // those of the rest positions
}
template <class I, class O>
constexpr bool stabilizes(DistanceMapping<I, O> const&) {
  return true;
}

}  // namespace sample
