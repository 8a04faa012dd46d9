// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <concepts>

namespace sinew {

/// Stands in the root and says in how many parts a step of the scene goes: contacts are found `collisionSteps`
/// times in a step, and after each time the solvers integrate `integrationSteps` times.
template <class C>
concept DividesSteps = HasRole<C, role::StepDivision> && requires(C c) {
  { c.collisionSteps } -> std::convertible_to<int>;
  { c.integrationSteps } -> std::convertible_to<int>;
};

template <>
struct Promise<role::StepDivision> : NoPromise {
  template <class C>
  static constexpr bool kept = DividesSteps<C>;
  template <class C>
  struct Broken {
    static_assert(
        DividesSteps<C>,
        "Sinew: a division of steps has no 'int collisionSteps = 1' and 'int integrationSteps = 1', "
        "which say how often contacts are found in a step, and how often solvers integrate after "
        "that.");
  };
};

}  // namespace sinew
