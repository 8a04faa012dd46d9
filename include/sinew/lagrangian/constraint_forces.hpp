// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// The field that asks for the multipliers of each step, of solvers that give them out under SOFA's names;
/// ConstrainedStep fills them.
template <class S>
constexpr auto asks_for_constraint_forces() {
  return field("computeConstraintForces",
               &S::computeConstraintForces,
               "",
               "keep the multipliers of each step in constraintForces");
}
template <class S>
constexpr auto constraint_forces_output() {
  return field_list(field("constraintForces",
                          &S::constraintForces,
                          "N, N m",
                          "multipliers of the last step, of all equations in their order: those of "
                          "constraints as they stand in the scene, then a normal and two tangents of each "
                          "contact"));
}

}  // namespace sinew
