// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Bodies answer to multipliers by the system of their ODE solver, u = c A^-1 J' f with its linear solver,
/// which is so without this component too, with c = 1: scene files of SOFA have it.
struct LinearSolverConstraintCorrection {
  using Role = role::ConstraintCorrection;
  static constexpr std::string_view className = "LinearSolverConstraintCorrection";
  static constexpr std::string_view aliases = "GenericConstraintCorrection";
  static constexpr bool ofSystem = true;

  double regularizationTerm = 0, complianceFactor = 1;

  static constexpr auto fields() {
    using C = LinearSolverConstraintCorrection;
    return field_list(field("regularizationTerm",
                            &C::regularizationTerm,
                            "m/(N s)",
                            "displacement for an impulse of 1 N s that is added to the compliance of each "
                            "equation, so that those that depend on each other can be solved",
                            range::nonNegative),
                      field("complianceFactor",
                            &C::complianceFactor,
                            "",
                            "the system answers so many times as much",
                            range::positive));
  }
};

}  // namespace sinew
