// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Calls f(StepInfo) or f(StepInfo, node) at the end of each step. A component, so that the call is direct.
template <class F>
struct StepCallback {
  using Role = role::StepCallback;
  static constexpr std::string_view className = "StepCallback";

  F call;

  static constexpr auto fields() { return field_list(); }
};
template <class F>
StepCallback(F) -> StepCallback<F>;

}  // namespace sinew
