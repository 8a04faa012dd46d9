// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

/// Stands in the root and says that a step is one with constraints: free motion, multipliers, correction
/// (scene/constrained_step.hpp). It keeps what that needs from step to step, `ConstrainedMotion motion`, and says
/// whether velocities come first, `bool solveVelocityConstraintFirst`.
template <class C>
concept KeepsMotion = requires(C c) {
  c.motion;
  { c.solveVelocityConstraintFirst } -> std::convertible_to<bool>;
};
template <class C>
concept AnimationLoop = HasRole<C, role::AnimationLoop> && KeepsMotion<C>;

template <>
struct Promise<role::AnimationLoop> : NoPromise {
  template <class C>
  static constexpr bool kept = AnimationLoop<C>;
  template <class C>
  struct Broken {
    static_assert(KeepsMotion<C>,
                  "Sinew: an animation loop has no 'ConstrainedMotion motion{}', which keeps the constraints "
                  "of a step, or no "
                  "'bool solveVelocityConstraintFirst = false'.");
  };
};

}  // namespace sinew
