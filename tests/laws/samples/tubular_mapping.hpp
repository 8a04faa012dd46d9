// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/tubular_mapping.hpp>

namespace sample {

template <class I, class O>
constexpr std::size_t child_points(TubularMapping<I, O> const&) {
  return 0;  // the mapping makes them
}
template <class I, class O>
void prepare(TubularMapping<I, O>& c, Random&) {
  c.nbPointsOnEachCircle = 3, c.peak = 4;
}

}  // namespace sample
