// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>

namespace sinew {

/// A step with constraints by Lagrange multipliers (Faure et al. 2012, SOFA): all bodies move freely; the
/// constraints at the end of that motion are d = d_free + W f with the compliance W = J A^-1 J' of the
/// bodies; a constraint solver finds the multipliers f [N]; and positions and velocities are corrected by
/// A^-1 J' f. It stands in the root. J is that at the start of the step, so that joints of bodies that turn
/// by w dt hold to (w dt)^2 of their levers; with `newtonIterations` above 0 they hold to `newtonTolerance`.
struct FreeMotionAnimationLoop {
  using Role = role::AnimationLoop;
  static constexpr std::string_view className = "FreeMotionAnimationLoop";
  static constexpr std::string_view aliases = "FreeMotionMasterSolver ConstraintAnimationLoop";
  // beside sinew.hpp: every scene with constraints has this component, and needs all of that
  static constexpr std::string_view header = "sinew/lagrangian.hpp";

  bool solveVelocityConstraintFirst = false;
  int newtonIterations = 0;
  double newtonTolerance = 1e-11;

  static constexpr auto fields() {
    return field_list(
        field("solveVelocityConstraintFirst",
              &FreeMotionAnimationLoop::solveVelocityConstraintFirst,
              "",
              "solve constraints for velocities, with which positions then move, in place of positions"),
        field(
            "newtonIterations",
            &FreeMotionAnimationLoop::newtonIterations,
            "",
            "largest number of further solutions in a step for equalities that turn within it to hold at its "
            "end; 0, as in SOFA: they hold by their tangents at its start",
            range::atLeast(0)),
        field("newtonTolerance",
              &FreeMotionAnimationLoop::newtonTolerance,
              "m",
              "change of what the tangents of constraints leave out at which to stop",
              range::positive));
  }

  ConstrainedMotion motion{};
};

}  // namespace sinew
