// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <string_view>

namespace sinew {

/// A step of the scene in smaller ones: contacts are found `collisionSteps` times, and after each time the
/// solvers integrate `integrationSteps` times over dt / (collisionSteps integrationSteps). Movements, sources
/// and tools go on with each of these; what is called after a step, such as a record, is called once. It
/// stands in the root. Besides a FreeMotionAnimationLoop each of the smaller steps is one with constraints.
struct MultiStepAnimationLoop {
  using Role = role::StepDivision;
  static constexpr std::string_view className = "MultiStepAnimationLoop";
  static constexpr std::string_view aliases = "MultiStepMasterSolver";

  int collisionSteps = 1, integrationSteps = 1;

  static constexpr auto fields() {
    return field_list(field("collisionSteps",
                            &MultiStepAnimationLoop::collisionSteps,
                            "",
                            "how often contacts are found in a step",
                            range::atLeast(1)),
                      field("integrationSteps",
                            &MultiStepAnimationLoop::integrationSteps,
                            "",
                            "how often the solvers integrate after contacts are found",
                            range::atLeast(1)));
  }
};

}  // namespace sinew
