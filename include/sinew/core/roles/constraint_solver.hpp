// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <concepts>
#include <string>
#include <string_view>

namespace sinew {

struct ConstraintProblem;

// Finds the multipliers of all constraints of a scene, in which an animation loop asks for them. The shortest:
//
//   /// One pass of projected Gauss-Seidel over rows that are all one-sided.
//   struct OnePass {
//     using Role = role::ConstraintSolver;
//     static constexpr std::string_view className = "OnePass";
//     static constexpr auto fields() { return field_list(); }
//
//     void solve(ConstraintProblem& problem, std::string_view) {
//       for (int i = 0; i < problem.rows(); ++i) {
//         const double d = problem.violation()[i];
//         problem.multipliers[i] = std::max(0.0, problem.multipliers[i] - d / problem.compliance(i, i));
//       }
//     }
//   };

/// Leaves the multipliers in the problem; where its iterations do not end, a result that is not `converged`
/// makes a warning of the step (SaysUnsolved). The second argument says in messages where the solver stands.
template <class C>
concept SolvesConstraintProblem =
    requires(C c, ConstraintProblem& problem, std::string_view where) { c.solve(problem, where); };

/// takesUnbuilt() says whether the compliance of its problems need not be a matrix (ConstraintProblem::built).
template <class C>
concept MayTakeUnbuilt = requires(C const& c) {
  { c.takesUnbuilt() } -> std::same_as<bool>;
};
template <class C>
bool takes_unbuilt([[maybe_unused]] C const& solver) {
  if constexpr (MayTakeUnbuilt<C>)
    return solver.takesUnbuilt();
  else
    return false;
}

/// It needs no compliance matrix, and finds the motion of the bodies with the multipliers (scene/motion_problem.hpp):
/// solveMotion(multiply, rows, where) with the product multiply(p, q), q = S p, and `preconditioner.system`, the diagonal
/// blocks of S.
template <class C>
concept SolvesMotion = named::solveMotion<C> && requires(C c) { c.preconditioner.system; };

/// It says whether the last problem is solved, and what to do where it is not.
template <class C>
concept SaysUnsolved = requires(C const c) {
  { c.result.converged } -> std::convertible_to<bool>;
  { c.unsolved() } -> std::convertible_to<std::string>;
};
/// Whether it has, as far as it says.
template <class C>
bool has_solved([[maybe_unused]] C const& solver) {
  if constexpr (SaysUnsolved<C>)
    return solver.result.converged;
  else
    return true;
}

/// A solver of the motion that lets others find it, where states are not in the host's memory: solveMotionBy(solve, where) calls
/// solve(ConvexStepSettings, std::vector<double>& lastMotion), which is ConvexStep::solve for them.
template <class C>
concept LetsMotionBeSolved = SolvesMotion<C> && named::solveMotionBy<C>;

template <class C>
concept ConstraintSolver =
    HasRole<C, role::ConstraintSolver> && (SolvesConstraintProblem<C> || SolvesMotion<C>);

template <>
struct Promise<role::ConstraintSolver> : NoPromise {
  template <class C>
  static constexpr bool kept = ConstraintSolver<C>;
  template <class C>
  struct Broken {
    static_assert(
        SolvesConstraintProblem<C> || SolvesMotion<C>,
        "Sinew: a constraint solver has no 'void solve(ConstraintProblem& problem, std::string_view where)', "
        "which finds the multipliers.");
  };
};

}  // namespace sinew
