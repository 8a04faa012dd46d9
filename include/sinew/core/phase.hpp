// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <array>
#include <string_view>

namespace sinew {

/// The parts of a step that a profile tells apart, beside components.
enum class Phase : int {
  step,
  beforeStep,
  collision,
  positions,
  boundingTrees,
  broadPhase,
  narrowPhase,
  response,
  carving,
  externalForces,
  force,
  mapping,
  mappingBack,
  contacts,
  constraint,
  acceleration,
  product,
  pattern,
  assembly,
  iteration,
  factorisation,
  substitution,
  endStep,
  visual
};
inline constexpr std::array<std::string_view, 24> enum_names(Phase) {
  return {"step",
          "before the step",
          "collision",
          "positions of models",
          "bounding trees",
          "broad phase",
          "narrow phase",
          "response",
          "carving",
          "forces between solvers",
          "force",
          "mapping",
          "mapping of forces",
          "contacts",
          "constraint",
          "acceleration",
          "product with the matrix",
          "pattern of the matrix",
          "assembly",
          "iteration",
          "factorisation",
          "substitution",
          "end of the step",
          "visual"};
}

/// What stands in the place of a timer in a scene that is not profiled.
struct NotTimed {};

}  // namespace sinew
