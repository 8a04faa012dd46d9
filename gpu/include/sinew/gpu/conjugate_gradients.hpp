// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/assembled_system.hpp>
#include <sinew/gpu/block_jacobi.hpp>
#include <sinew/gpu/team_solver.hpp>
#include <sinew/gpu/vector_operations.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/linear_system.hpp>

#include <type_traits>
#include <utility>

namespace sinew::gpu {

namespace detail {
// f(TeamSolver) of the bodies of a solver, if the first of them is one of points
template <class Operations, class F>
void with_team(Operations& operations, F&& f) {
  bool first = true;
  operations.forEachIndependent([&](auto& state) {
    const bool is = std::exchange(first, false);
    if constexpr (SolvesMotions<typename std::decay_t<decltype(state)>::DataTypes>)
      if (is) f(state.solverWorkspace.team);
  });
}
}  // namespace detail

/// What CGLinearSolver does where all states below it are on the device, and what
/// ShewchukPCGLinearSolver does with a preconditioner of diagonal blocks: the same method with its numbers
/// there, so that nothing waits for the host; over an assembled matrix one kernel. With a tolerance the host
/// looks every tenth iteration whether more are needed, but not while the step is being recorded. `residuals`
/// stays empty.
template <class Operations, class Solver, class MultiVec>
void conjugate_gradients(Operations& operations, Solver& solver, MatrixFactors factors, MultiVec& x,
                         MultiVec& b, DeviceVector<double>& numbers) {
  MultiVec r(operations), p(operations), q(operations);
  bool preconditioned = false;
  if constexpr (requires { solver.age; }) {
    const PreconditionerMethod method = solver.method();
    preconditioned = method != PreconditionerMethod::none;
    if (preconditioned && solver.age == 0)
      make_block_jacobi(operations, factors, method == PreconditionerMethod::jacobi, p, q);
  }
  constexpr bool assembled = !Solver::matrixFree;
  double threshold = 0;
  if constexpr (requires { solver.threshold; }) threshold = solver.threshold;
  if constexpr (assembled) {
    assemble_on_device(operations, factors, p, q);
    bool done = false;
    if (!preconditioned)
      detail::with_team(operations,
                        [&](auto& team) { done = team.solve(operations, solver, threshold, x, b, p); });
    if (done) {
      solver.residuals.clear();
      return;
    }
  }
  const auto n = std::size_t(solver.iterations);
  numbers.resize(3 * n + 6);
  double* const workspace = numbers.device();
  const CgScalars s{workspace,
                    preconditioned ? workspace + n + 2 : workspace,
                    workspace + 2 * n + 4,
                    solver.tolerance * solver.tolerance,
                    threshold};
  double* const ofState = workspace + 3 * n + 5;
  solver.residuals.clear();

  // *to = what f(state, sum) puts into *sum, over all states
  auto sum = [&](double* to, auto&& f) {
    bool first = true;
    operations.forEachIndependent([&](auto& state) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      if constexpr (OnDevice<D>) {
        f.template operator()<VectorOperations<D>>(state, first ? to : ofState);
        double* const from = ofState;
        if (!first) for_each_index(1, AddTo{to, from});
        first = false;
      }
    });
  };
  // z = P^-1 r, and r.z
  auto precondition = [&](MultiVec& z, double* to) {
    sum(to, [&]<class V>(auto& state, double* rz) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      sum_indices(state.size(),
                  typename PointBlocks<D>::Apply{{int(state.size()), state.solverWorkspace.diagonal.device()},
                                                 std::as_const(state[r.id]).device(),
                                                 state[z.id].overwrite()},
                  rz);
    });
    operations.projectResponse(z.id);  // a block may join a component that is fixed with one that is not
  };
  x.clear();
  r.eq(b);
  sum(s.size, [&]<class V>(auto& state, double* to) { V::dot(state[r.id], state[r.id], to); });
  if (preconditioned)
    precondition(p, s.rho);
  else
    p.eq(b);
  for (int i = 0; i < solver.iterations; ++i) {
    if constexpr (assembled) {
      // p has nothing that constraints forbid, so that p.Ap may be summed up before they act on Ap
      sum(s.curvature + i, [&]<class V>(auto& state, double* to) {
        state.solverWorkspace.rows.multiply(state[q.id].overwrite(), std::as_const(state[p.id]).device(), to);
      });
      operations.projectResponse(q.id);
    } else {
      q.clear();
      operations.addMBKdx(q.id, p.id, factors);
      operations.projectResponse(q.id);
      sum(s.curvature + i, [&]<class V>(auto& state, double* to) { V::dot(state[p.id], state[q.id], to); });
    }
    sum(s.size + i + 1, [&]<class V>(auto& state, double* to) {
      V::advance(state[x.id], state[p.id], state[r.id], state[q.id], s, i, to);
    });
    MultiVec& next = preconditioned ? q : r;
    if (preconditioned) precondition(next, s.rho + i + 1);
    operations.forEachIndependent([&](auto& state) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      if constexpr (OnDevice<D>) VectorOperations<D>::xpay(state[p.id], state[next.id], s, i);
    });
    if (solver.tolerance > 0 && i % 10 == 9 && !recording()) {
      double size[2];
      copy_to_host(size, s.size, 1);
      copy_to_host(size + 1, s.size + i + 1, 1);
      if (!(size[1] > s.tolerance2 * size[0])) break;
    }
  }
  detail::with_team(operations, [&](auto& team) { team.leave(operations, r, assembled); });
}

}  // namespace sinew::gpu
