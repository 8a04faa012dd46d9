// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/roles/ode_solver.hpp>

namespace sinew {

// Solves (m M + b B + k K) x = b for the implicit ODE solvers of its node and below. The shortest:
//
//   /// A few steps of steepest descent, from x = 0.
//   struct SteepestDescent {
//     using Role = role::LinearSolver;
//     static constexpr std::string_view className = "SteepestDescent";
//     static constexpr Auxiliary auxiliary{.derivs = 2};
//     static constexpr bool needsPattern = false;
//     static constexpr auto fields() { return field_list(); }
//
//     template <class Operations>
//     void init(Operations&) {}
//     template <class Operations, class Vector>
//     void solve(Operations& o, MatrixFactors factors, Vector& x, Vector& b) const {
//       Vector r(o), q(o);
//       x.clear();
//       r.eq(b);
//       for (int i = 0; i < 50 && r.dot(r) > 0; ++i) {
//         q.clear();
//         o.addMBKdx(q.id, r.id, factors);
//         o.projectResponse(q.id);
//         const double step = r.dot(r) / r.dot(q);
//         x.peq(r, step);
//         r.peq(q, -step);
//       }
//     }
//   };

/// Is called once, and where the pattern of the matrix has changed.
template <class C>
concept HasInitOfSystem = requires(C c, AnyOperations operations) { c.init(operations); };

template <class C>
concept LinearSolver =
    HasRole<C, role::LinearSolver> && SaysAuxiliary<C> && HasInitOfSystem<C> && may_have<C>(named::solve<C>);

// Hook:

/// A linear solver that keeps a matrix, whose pattern is fixed at init and when contacts join other points;
/// one that does not says so, `static constexpr bool needsPattern = false`.
template <class C>
inline constexpr bool needs_pattern = !requires { requires !C::needsPattern; };

/// Solves once more with the matrix of the last solve, at the same positions: solveAgain(operations, x, b). What the
/// responses of bodies to constraints need; where it is not there, the matrix is made again.
template <class C>
concept HasSolveAgain = named::solveAgain<C>;

template <>
struct Promise<role::LinearSolver> : NoPromise {
  template <class C>
  static constexpr bool kept = LinearSolver<C>;
  template <class C>
  struct Broken {
    static_assert(SaysAuxiliary<C>,
                  "Sinew: a linear solver does not say how many auxiliary vectors it takes; write 'static "
                  "constexpr Auxiliary auxiliary{.derivs = 3};'.");
    static_assert(
        HasInitOfSystem<C>,
        "Sinew: a linear solver has no 'template <class Operations> void init(Operations& operations)'.");
    static_assert(
        may_have<C>(named::solve<C>),
        "Sinew: a linear solver has no 'template <class Operations> void solve(Operations& operations, "
        "MatrixFactors factors, MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b)', which "
        "solves (m M + b B + k K) x = b.");
  };
};

}  // namespace sinew
