// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/vector_operations.hpp>
#include <sinew/solver/cg_linear_solver.hpp>

namespace sinew::gpu {

/// What CGLinearSolver<GraphScattered> does where all states below it are on the device: the same method with
/// its numbers there, so that nothing waits for the host. With a tolerance the host looks every tenth
/// iteration whether more are needed, but not while the step is being recorded. `residuals` stays empty.
template <class Operations, class Solver, class MultiVec>
void conjugate_gradients(Operations& operations, Solver& solver, MatrixFactors factors, MultiVec& x, MultiVec& b,
                         DeviceVector<double>& numbers) {
  MultiVec r(operations), p(operations), q(operations);
  const auto n = std::size_t(solver.iterations);
  numbers.resize(2 * n + 4);
  double* const room = numbers.device();
  const CgScalars s{room, room + n + 2, solver.tolerance * solver.tolerance, solver.threshold};
  double* const ofState = room + 2 * n + 3;
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
  x.clear();
  r.eq(b);
  p.eq(b);
  sum(s.rho, [&]<class V>(auto& state, double* to) { V::dot(state[r.id], state[r.id], to); });
  for (int i = 0; i < solver.iterations; ++i) {
    q.clear();
    operations.addMBKdx(q.id, p.id, factors);
    operations.projectResponse(q.id);
    sum(s.curvature + i, [&]<class V>(auto& state, double* to) { V::dot(state[p.id], state[q.id], to); });
    sum(s.rho + i + 1, [&]<class V>(auto& state, double* to) {
      V::advance(state[x.id], state[p.id], state[r.id], state[q.id], s, i, to);
    });
    operations.forEachIndependent([&](auto& state) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      if constexpr (OnDevice<D>) VectorOperations<D>::turn(state[p.id], state[r.id], s, i);
    });
    if (solver.tolerance > 0 && i % 10 == 9 && !recording()) {
      double rho[2];
      copy_to_host(rho, s.rho, 1);
      copy_to_host(rho + 1, s.rho + i + 1, 1);
      if (!(rho[1] > s.tolerance2 * rho[0])) return;
    }
  }
}

}  // namespace sinew::gpu
