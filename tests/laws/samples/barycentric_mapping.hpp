// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/barycentric_mapping.hpp>

namespace sample {

template <class I, class O>
constexpr std::size_t child_points(BarycentricMapping<I, O> const&) {
  return 40;
}

}  // namespace sample
