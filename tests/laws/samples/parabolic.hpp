// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/constraint/parabolic.hpp>

namespace sample {

template <class... A>
void prepare(ParabolicConstraint<A...>& c, Random&) {
  c.beginTime = 0, c.endTime = 2;
}
// points that have one coordinate are on every line
template <class D>
constexpr bool has_laws(ParabolicConstraint<D> const&) {
  return D::size > 1;
}

}  // namespace sample
