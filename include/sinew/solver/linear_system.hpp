// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/linalg/block_matrix.hpp>
#include <sinew/solver/multi_vec.hpp>
#include <sinew/state/vector_operations.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// The matrix of a solver that never forms it: products go through the scene graph.
struct GraphScattered {
  static constexpr std::string_view name = "GraphScattered";
};

/// DataTypes that solve systems over their vectors by themselves (VectorOperations::solve), where the host
/// would have to bring these vectors to its memory.
template <class D>
concept SolvesSystems = requires { requires VectorOperations<D>::solvesSystems; };

/// Those that also find the motion with multipliers, for constraint solvers that need no compliance matrix
/// (scene/motion_problem.hpp): the workspace of their states has what does it, `motion`.
template <class D>
concept SolvesMotions = SolvesSystems<D> && requires { requires VectorOperations<D>::solvesMotions; };

/// Whether all states of a solver are over such; with `restart` their workspace is cleared.
/// `assembled`: the solver forms a matrix.
template <class Operations>
bool states_solve(Operations& operations, bool assembled, bool restart = false) {
  bool first = true, can = false;
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (SolvesSystems<D>) {
      if (restart) state.solverWorkspace = {};
      can = first ? !assembled || VectorOperations<D>::assembles(operations) : can;
    } else {
      can = false;
    }
    first = false;
  });
  return can;
}
/// Solves by what the first state's DataTypes bring for it, with room for three vectors.
template <class Solver, class Operations>
void let_states_solve(Solver& solver, Operations& operations, MatrixFactors factors,
                      MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b) {
  operations.reserve({.derivs = operations.derivsTaken + 3});
  bool first = true;
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (SolvesSystems<D>)
      if (std::exchange(first, false))
        VectorOperations<D>::solve(solver, operations, factors, x, b, state.solverWorkspace.numbers);
  });
}

/// The same with multigrid; false where these DataTypes cannot, and the host has to. `update`: the cycle is
/// made anew; `again`: the matrix is that of the last solve.
template <class Solver, class Operations>
bool let_states_solve_by_multigrid(Solver& solver, Operations& operations, MatrixFactors factors,
                                   MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b, bool update,
                                   bool again) {
  operations.reserve({.derivs = operations.derivsTaken + 4});
  bool first = true, solved = false;
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (SolvesSystems<D>)
      if (std::exchange(first, false))
        solved = VectorOperations<D>::solveByMultigrid(solver, operations, factors, x, b, update, again);
  });
  return solved;
}

/// What an iteration multiplies its result with where it meets a number that is not finite: the state says
/// then that the simulation has diverged, where a method that stops would leave it standing still without a
/// word.
inline constexpr double notSolved = std::numeric_limits<double>::quiet_NaN();

/// Room for |b - A x| / |b| of each iteration, of the first million at most.
inline void reserve_residuals(std::vector<double>& residuals, int iterations) {
  residuals.clear();
  residuals.reserve(std::size_t(std::min(iterations, 1'000'000)) + 1);
}
/// Keeps one, as long as there is room: a step allocates nothing.
inline void keep_residual(std::vector<double>& residuals, double value) {
  if (residuals.size() < residuals.capacity()) residuals.push_back(value);
}

/// "point 7, component 1 of MechanicalObject<Vec3d>": what messages say of an unknown of the system.
template <class Operations>
std::string dof_text(Operations& operations, int dof) {
  std::string words;
  operations.forEachIndependent([&](auto& s) {
    using S = std::decay_t<decltype(s)>;
    constexpr int size = S::DataTypes::size;
    const int own = dof - s.dofOffset;
    if (own >= 0 && own < int(s.size()) * size)
      words = text("point ", own / size, ", component ", own % size, " of ", component_name<S>());
  });
  return words;
}

/// A vector of the assembled system, with the mathematics of MultiVecDeriv: methods are written once over
/// both.
template <class Vector>
struct SystemVec {
  using Real = typename Vector::Scalar;
  Vector& v;

  void clear() { v.setZero(); }
  void eq(SystemVec const& a) { v = a.v; }
  void eq(SystemVec const& a, double f) { v = Real(f) * a.v; }
  void peq(SystemVec const& a, double f = 1) { v += Real(f) * a.v; }
  void teq(double f) { v *= Real(f); }
  double dot(SystemVec const& a) const { return double(vec::product(v, a.v)); }
};

}  // namespace sinew
