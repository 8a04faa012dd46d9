// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// Midpoint method (Runge-Kutta 2), order 2, as the introduction to SOFA writes it.
struct RungeKutta2Solver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "RungeKutta2Solver";
  static constexpr std::string_view aliases = "RungeKutta2";
  static constexpr bool implicit = false;
  static constexpr int convergenceOrder = 2;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 2};

  static constexpr auto fields() { return field_list(); }

  template <class Operations>
  void solve(Operations& operations, double dt) const {
    const double startTime = operations.time;
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity);
    auto computeAcc = [&](double t, auto& a, auto const& x, auto const& v) {
      operations.computeAcc(t, a, x, v);
    };

    MultiVecDeriv acc(operations);
    MultiVecCoord newX(operations);
    MultiVecDeriv newV(operations);
    // state derivative: vel is the derivative of pos, acc that of vel
    computeAcc(startTime, acc, pos, vel);
    // a step of dt/2 along it
    newX = pos;
    newX.peq(vel, dt / 2);
    newV = vel;
    newV.peq(acc, dt / 2);
    // the derivative in the middle serves the whole step
    computeAcc(startTime + dt / 2, acc, newX, newV);
    operations.acted.add(vec_id::force);
    pos.peq(newV, dt);
    vel.peq(acc, dt);
  }
};

}  // namespace sinew
