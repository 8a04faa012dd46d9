// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/identity_multi_mapping.hpp>

namespace sample {

template <class... A>
constexpr std::size_t child_points(IdentityMultiMapping<A...> const&) {
  return 0;  // the mapping makes them
}

}  // namespace sample
