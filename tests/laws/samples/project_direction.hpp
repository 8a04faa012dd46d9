// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/project_direction.hpp>

namespace sample {

// points that have one coordinate are on every line
template <class D>
constexpr bool has_laws(ProjectDirectionConstraint<D> const&) {
  return D::size > 1;
}

}  // namespace sample
