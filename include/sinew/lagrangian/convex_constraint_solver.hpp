// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constrained_block_jacobi.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/lagrangian/constraint_forces.hpp>
#include <sinew/lagrangian/convex_step.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The step with its constraints as a sequence of convex problems for the motion of the bodies (Castro,
/// Permenter, Han 2022; Todorov 2014), each solved by Newton's method with matrix-free conjugate gradients,
/// in which a contact is one more element. The compliance W = J A^-1 J' is never formed, so that the cost
/// hardly grows with the number of constraints. The multipliers fulfil the same conditions as those of the
/// other solvers, Coulomb's law among them, to the tolerance. A step starts from the multipliers of the one
/// before, and from its motion, scaled to what these would do.
struct ConvexConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "ConvexConstraintSolver";

  double tolerance = 1e-6, momentumTolerance = 1e-6;
  int maxUpdates = 50, maxIterations = 10000;
  bool stopsUnsolved = false;
  bool computeConstraintForces = false;

  static constexpr auto fields() {
    using S = ConvexConstraintSolver;
    return field_list(field("tolerance",
                            &S::tolerance,
                            "m",
                            "largest violation of a condition of a constraint at which to stop (natural map)",
                            range::positive),
                      field("momentumTolerance",
                            &S::momentumTolerance,
                            "",
                            "difference of the momentum of the bodies and the impulse of the multipliers at "
                            "which to stop, relative",
                            range::positive),
                      field("maxUpdates",
                            &S::maxUpdates,
                            "",
                            "largest number of convex problems in a step",
                            range::atLeast(1)),
                      field("maxIterations",
                            &S::maxIterations,
                            "",
                            "largest number of iterations of conjugate gradients in a step",
                            range::atLeast(1)),
                      field("stopsUnsolved",
                            &S::stopsUnsolved,
                            "",
                            "an Error where the iterations end above the tolerances; else a warning, and the "
                            "step goes on with what they have found"),
                      asks_for_constraint_forces<S>());
  }
  static constexpr auto outputs() { return constraint_forces_output<ConvexConstraintSolver>(); }
  std::vector<double> constraintForces{};

  std::vector<double> lastMotion{};

  static constexpr auto state() {
    return field_list(field("lastMotion",
                            &ConvexConstraintSolver::lastMotion,
                            "m",
                            "what the multipliers of the last step added to the motion of the bodies"));
  }
  void reset() {
    lastMotion.clear();
    constraintForces.clear();
  }

  ConvexStepResult result{};  // of the last step
  ConstrainedBlockJacobi<3> preconditioner{};
  ConvexStep step{};
  Eigen::VectorXd none{}, impulse{}, product{};

  template <class Multiply>
  void solveMotion(Multiply&& multiply, MotionRows& rows, std::string_view where) {
    none.setZero(rows.dofs);
    guess(multiply, rows);
    solveMotionBy(
        [&](ConvexStepSettings const& settings, std::vector<double>&) {
          const ConvexStepResult found = step.solve(multiply,
                                                    preconditioner,
                                                    none,
                                                    rows.jacobian,
                                                    rows.blocks,
                                                    rows.start,
                                                    rows.motion,
                                                    rows.multipliers,
                                                    settings,
                                                    where);
          lastMotion.assign(rows.motion.begin(), rows.motion.end());
          return found;
        },
        where);
  }
  /// The same by a method of other states: solve(settings, lastMotion) starts from the last motion, scaled,
  /// leaves the new one there and multipliers in their rows, and returns what has come of it.
  template <class Solve>
  void solveMotionBy(Solve&& solve, std::string_view where) {
    ConvexStepSettings settings;
    settings.tolerance = tolerance;
    settings.momentumTolerance = momentumTolerance;
    settings.maxUpdates = maxUpdates;
    settings.maxConjugateGradients = maxIterations;
    result = solve(settings, lastMotion);
    if (stopsUnsolved && !result.converged) throw Error(where, unsolved());
  }
  std::string unsolved() const {
    return text(
        className,
        ": the constraints are not solved after ",
        result.conjugateGradients,
        " iterations in ",
        result.updates,
        result.updates == 1 ? " convex problem" : " convex problems",
        ": the residual is ",
        result.residual,
        " m, the tolerance ",
        tolerance,
        result.momentum <= momentumTolerance ? std::string()
                                             : text("; the momentum is off by ",
                                                    result.momentum,
                                                    " (relative), the tolerance ",
                                                    momentumTolerance),
        "; allow more (maxUpdates, maxIterations), or look for constraints that contradict each other");
  }

 private:
  // v = a v_last that is nearest to S^-1 J' f in the energy, by the multipliers f of the last step; where
  // degrees of freedom came or went, and where it would not help, 0
  template <class Multiply>
  void guess(Multiply& multiply, MotionRows& rows) {
    rows.motion.setZero(rows.dofs);
    if (lastMotion.size() != std::size_t(rows.dofs)) return;
    const Eigen::Map<Eigen::VectorXd const> last(lastMotion.data(), rows.dofs);
    rows.motion = last;
    impulse.setZero(rows.dofs);
    rows.jacobian.addTransposed(rows.multipliers, impulse);
    multiply(rows.motion, product);
    const double energy = last.dot(product), work = last.dot(impulse);
    rows.motion *= energy > 0 && work > 0 ? work / energy : 0.;
  }
};

}  // namespace sinew
