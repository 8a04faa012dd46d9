// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/beam_linear_mapping.hpp>

namespace sample {

template <class I, class O>
constexpr std::size_t child_points(BeamLinearMapping<I, O> const&) {
  return 40;
}

}  // namespace sample
