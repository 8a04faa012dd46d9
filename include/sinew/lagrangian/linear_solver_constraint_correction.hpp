// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Bodies answer to multipliers by the system of their ODE solver, u = A^-1 J' f with its linear solver,
/// which is so without this component too: scene files of SOFA have it.
struct LinearSolverConstraintCorrection {
  using Role = role::ConstraintCorrection;
  static constexpr std::string_view className = "LinearSolverConstraintCorrection";
  static constexpr std::string_view aliases = "GenericConstraintCorrection";
  static constexpr bool ofSystem = true;

  static constexpr auto fields() { return field_list(); }
};

}  // namespace sinew
