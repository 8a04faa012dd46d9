// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>
#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

struct ConvexStepSettings {
  double tolerance = 1e-6;          // of the natural map, in the unit of the violation
  double momentumTolerance = 1e-6;  // of A v - b = J' f, relative
  FrictionLag friction = FrictionLag::bound;

  /// Of each row, over the mean diagonal of the estimated W of its block: at first, and times `decrease` at
  /// each update until it is `regularisation`. Where that is what holds convergence up, it decreases on to
  /// `leastRegularisation`.
  double firstRegularisation = 20;
  double decrease = 0.3, regularisation = 0.1, leastRegularisation = 1e-3;

  double reduction = 0.1;  // of the gradient between two updates
  double forcing = 0.1;    // of the residual of Newton's equation
  int patience = 10;       // updates without half the residual, before what is lagged changes
  int maxUpdates = 50;
  int maxNewtonIterations = 30;       // between two updates
  int maxConjugateGradients = 10000;  // in total
};

struct ConvexStepResult {
  int updates = 0, newtonIterations = 0, conjugateGradients = 0, lineSearches = 0;
  double residual = 0;  // ConstraintProblem::residual, with an estimate of W
  double momentum = 0;  // |A v - b - J' f| in the preconditioner's norm, over sqrt(v' A v) or |J' f|
  bool converged = true;
};

/// Throws Error where sizes do not fit, or a number is not finite.
void check_convex_step(Eigen::VectorXd const& b, JacobianRows const& J,
                       std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& start,
                       Eigen::VectorXd const& velocity, Eigen::VectorXd const& multipliers,
                       std::string_view where);

/// The same of violations and multipliers alone.
void check_convex_guess(Eigen::VectorXd const& start, Eigen::VectorXd const& multipliers,
                        std::string_view where);
/// The same of rows alone, over so many dofs.
void check_convex_rows(int dofs, JacobianRows const& J, std::vector<ConstraintBlock> const& blocks,
                       Eigen::VectorXd const& start, Eigen::VectorXd const& multipliers,
                       std::string_view where);

/// Throws the Error of a step whose momentum, as it is solved, is not finite.
[[noreturn]] void refuse_unbounded_step(std::string_view where);

/// Throws Error where a setting is out of its range.
void check_convex_step(ConvexStepSettings const& s, std::string_view where);

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void check_convex_step(Eigen::VectorXd const& b, JacobianRows const& J,
                                  std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& start,
                                  Eigen::VectorXd const& velocity, Eigen::VectorXd const& multipliers,
                                  std::string_view where) {
  if (velocity.size() != b.size())
    throw Error(where,
                text("a step of ", b.size(), " dofs has ", velocity.size(), " velocities; give each one"));
  if (!b.allFinite() || !velocity.allFinite())
    throw Error(where, "a momentum or a velocity of a step with constraints is not a finite number");
  check_convex_guess(start, multipliers, where);
  check_convex_rows(int(b.size()), J, blocks, start, multipliers, where);
}

SINEW_ONCE void check_convex_guess(Eigen::VectorXd const& start, Eigen::VectorXd const& multipliers,
                                   std::string_view where) {
  if (!start.allFinite() || !multipliers.allFinite())
    throw Error(where, "a violation or a multiplier of a step with constraints is not a finite number");
}

SINEW_ONCE void check_convex_rows(int dofs, JacobianRows const& J, std::vector<ConstraintBlock> const& blocks,
                                  Eigen::VectorXd const& start, Eigen::VectorXd const& multipliers,
                                  std::string_view where) {
  if (start.size() != J.rows() || multipliers.size() != J.rows())
    throw Error(where,
                text("constraints have ",
                     J.rows(),
                     " rows, ",
                     start.size(),
                     " violations and ",
                     multipliers.size(),
                     " multipliers; give each as many"));
  J.check(dofs, where);
  check_blocks(blocks, J.rows(), where);
}

SINEW_ONCE void refuse_unbounded_step(std::string_view where) {
  throw Error(where,
              "the system of a step with constraints is not finite; see whether the time step is too large "
              "for the forces before it");
}

SINEW_ONCE void check_convex_step(ConvexStepSettings const& s, std::string_view where) {
  for (const double positive : {s.firstRegularisation, s.regularisation, s.leastRegularisation, s.decrease})
    if (!(positive > 0) || !std::isfinite(positive))
      throw Error(where,
                  text("a regularisation of a step with constraints, or its decrease, is ",
                       positive,
                       "; it needs a positive number"));
  for (const double part : {s.reduction, s.forcing})
    if (!(part > 0 && part < 1))
      throw Error(where,
                  text("the reduction or the forcing of a step with constraints is ",
                       part,
                       "; it is a part, between 0 and 1"));
  if (!(s.tolerance >= 0) || !(s.momentumTolerance >= 0))
    throw Error(where, "a tolerance of a step with constraints is negative or not a number; it is 0 or more");
}

}  // namespace sinew
#endif
