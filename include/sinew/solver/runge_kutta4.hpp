// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// Classical Runge-Kutta method, order 4. Rotations are advanced in the chart of exponential coordinates
/// (Munthe-Kaas 1999), so that the order holds for rigid bodies too; for points the chart is the identity.
struct RungeKutta4Solver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "RungeKutta4Solver";
  static constexpr std::string_view aliases = "RungeKutta4";
  static constexpr bool implicit = false;
  static constexpr int convergenceOrder = 4;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 7};

  static constexpr auto fields() { return field_list(); }

  template <class Operations>
  void solve(Operations& operations, double dt) const {
    const double startTime = operations.time;
    MultiVecCoord pos(operations, vec_id::position), newX(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), newV(operations);
    MultiVecDeriv k(operations), acc(operations), theta(operations), sumK(operations), sumA(operations),
        startV(operations);

    // stage 1
    operations.computeAcc(startTime, acc, pos, vel);
    operations.acted.add(vec_id::force, 1. / 6);
    startV = vel;
    k = vel;
    sumK = k;
    sumA = acc;
    const double step[] = {0.5, 0.5, 1}, weight[] = {2, 2, 1};
    for (int stage = 0; stage < 3; ++stage) {
      theta.eq(k, step[stage] * dt);
      newX = pos;
      newX.peq(theta);
      newV = startV;
      newV.peq(acc, step[stage] * dt);
      operations.computeAcc(startTime + step[stage] * dt, acc, newX, newV);
      operations.acted.add(vec_id::force, weight[stage] / 6);
      operations.chartRate(k.id, theta.id, newV.id);
      sumK.peq(k, weight[stage]);
      sumA.peq(acc, weight[stage]);
    }
    pos.peq(sumK, dt / 6);
    vel.peq(sumA, dt / 6);
  }
};

}  // namespace sinew
