// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/control/interventional_radiology_controller.hpp>

namespace sample {

/// It holds frames once a step has begun: its own test has what the laws ask.
template <class D>
constexpr bool has_laws(InterventionalRadiologyController<D> const&) {
  return false;
}

}  // namespace sample
