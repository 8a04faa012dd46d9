// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/anderson_acceleration.hpp>
#include <sinew/lagrangian/constraint_problem.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>
#include <sinew/linalg/block_matrix.hpp>
#include <sinew/linalg/factored_rows.hpp>

#include <utility>
#include <vector>

namespace sinew {

/// The rows that act on the bodies of one ODE solver, over the degrees of freedom of its system.
struct ConstrainedSystem {
  std::vector<int> rows{};      // which of all they are, rising
  JacobianRows jacobian{};      // of those, without what projective constraints take away
  JacobianRows whole{};         // with that, where forces are kept
  std::vector<int> lastRows{};  // those of the step before
  JacobianRows lastJacobian{};
  JacobianRows answers{};  // what the rows, as forces, do to the degrees of freedom, where W is not built
  Eigen::VectorXd force{}, motion{};  // of all degrees of freedom, and one number more
  bool joined = false;                // projective constraints give several points one motion

  // where points answer alone: what a unit force in each of their directions does, a column each; of each
  // degree of freedom the first of its point, and how many that has
  Reserved<Eigen::MatrixXd> pointAnswers{};
  std::vector<int> pointBegin{}, pointSize{};

  // for solvers that need no compliance (scene/motion_problem.hpp)
  CompressedRowSparseMatrixMat3x3d matrix{};  // A
  bool hasPattern = false;
  double scale = 1;  // S = scale A
  int begin = 0;     // of its degrees of freedom among those of all systems

  int dofs() const { return int(force.size()) - 1; }
  Eigen::Matrix3d block(int row) const {
    return Eigen::Map<CompressedRowSparseMatrixMat3x3d::Block const>(
        matrix.block(matrix.rowStart[std::size_t(row)]));
  }

  /// Begins the rows of another step.
  void clear() {
    rows.swap(lastRows);
    std::swap(jacobian, lastJacobian);
    rows.clear();
    jacobian.clear();
  }
  bool rowsAsBefore() const { return rows == lastRows && jacobian == lastJacobian; }
  /// Adds to a row, which is the last or one behind it.
  void add(int row, int dof, double value) {
    if (rows.empty() || rows.back() != row) {
      rows.push_back(row);
      jacobian.addRow();
    }
    jacobian.addToLast(dof, value);
  }
};

/// Where a system adds the compliance of pairs of its rows, once for each pair: W of all rows is symmetric.
/// Of a W that is not built these are rows of one block.
struct SystemCompliance {
  std::vector<int> const& rows;  // of the system: which of all they are
  ConstraintProblem& whole;
  double factor = 1;

  SystemCompliance times(double by) const { return {rows, whole, factor * by}; }
  void operator()(int k, int l, double w) const {
    const int i = rows[std::size_t(k)], j = rows[std::size_t(l)];
    whole.add(i, j, factor * w);
    if (i != j) whole.add(j, i, factor * w);
  }
};

/// The rows of all systems together, of blocks that something can part.
struct MotionRows {
  std::vector<int> rows{};  // which of all they are
  std::vector<ConstraintBlock> blocks{};
  JacobianRows jacobian{};
  int dofs = 0;
  std::vector<double> slack{};  // S of the degrees of freedom that rows have for themselves
  Eigen::VectorXd start{}, multipliers{}, motion{};
  std::vector<std::size_t> next{};  // of each system the row that comes next
  int step = -1;                    // ConstrainedMotion::step in which they were joined
  bool byMatrix = false;            // `slack` has a number that is that of the matrix of this step

  void clear() {
    rows.clear();
    blocks.clear();
    jacobian.clear();
  }
  void dropFrom(int row) {
    const auto r = std::size_t(row);
    jacobian.dofs.resize(std::size_t(jacobian.first[r]));
    jacobian.values.resize(std::size_t(jacobian.first[r]));
    jacobian.first.resize(r + 1);
    rows.resize(r);
  }
};

/// The rows that are to hold where the bodies end (scene/turning_constraints.hpp).
struct TurningRows {
  std::vector<int> rows{};           // which of all they are, rising
  Eigen::VectorXd free{}, linear{};  // violations of the free motion, and what the tangent makes of them
  Eigen::VectorXd shift{}, found{};  // what the tangent leaves out, as it is taken and as it was found
  Eigen::VectorXd weights{};         // all alike
  AndersonAcceleration acceleration{};
  ConstraintRows seen{};  // of a constraint, at the end of the step
};

/// What a scene with constraints by multipliers keeps from step to step: the rows of the last step, their
/// multipliers, and room.
struct ConstrainedMotion {
  ConstraintRows rows{}, lastRows{};  // lastRows: of the step before
  ConstraintProblem problem{};        // of the last step; multipliers in N
  std::vector<ConstrainedSystem> systems{};
  std::vector<int> rowsOf{};  // how many each constraint has, in the order of the scene
  int step = 0;               // steps so far
  int contactRows = 0;        // the first row behind them: those of contacts
  int lookedThrough = 0;      // so many rows had those constraints when dependent ones were looked for
  MotionRows motionRows{};
  JacobianRows room{};
  std::vector<char> acts{};  // of each row: whether it acts on a degree of freedom
  FactoredRows factored{};
  bool hasMotion = false;    // the solver has found the motion of systems with the multipliers
  int newtonIterations = 0;  // of constraints that turn within a step
  double newtonTolerance = 0;
  TurningRows turning{};
  // violations of contacts that states have found are theirs to say: those in `rows` are of no motion
  bool owesViolations = false;
  // whether all rows are theirs, in a form that may stand, and whether those of the last step do so
  bool mayStand = false, stands = false;
};

}  // namespace sinew
