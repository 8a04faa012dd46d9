// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>

#include <vector>

namespace sinew {

/// The rows that act on the bodies of one ODE solver, over the degrees of freedom of its system.
struct ConstrainedSystem {
  std::vector<int> rows{};  // which of all they are, rising
  JacobianRows jacobian{};  // of those
  Eigen::VectorXd force{}, motion{};

  void clear() {
    rows.clear();
    jacobian.clear();
  }
  /// Adds to a row, which is the last or one behind it.
  void add(int row, int dof, double value) {
    if (rows.empty() || rows.back() != row) {
      rows.push_back(row);
      jacobian.addRow();
    }
    jacobian.addToLast(dof, value);
  }
};

/// What a scene with constraints by multipliers keeps from step to step: the rows of the last step, their
/// multipliers, and room.
struct ConstrainedMotion {
  ConstraintRows rows{};
  ConstraintProblem problem{};  // of the last step; multipliers in N
  std::vector<ConstrainedSystem> systems{};
  std::vector<int> rowsOf{};  // how many each constraint has, in the order of the scene
  int contactRows = 0;        // the first row behind them: those of contacts
};

}  // namespace sinew
