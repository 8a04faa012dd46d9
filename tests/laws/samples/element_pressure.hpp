// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/element_pressure.hpp>

namespace sample {

template <class... A>
void prepare(ElementPressure<A...>& c, Random&) {
  for (int& i : c.pressedElements) i %= 24;  // quads of the body
  c.dmin = 0, c.dmax = 1;
}

}  // namespace sample
