// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// Implicit Euler, order 1, linearised once a step (Baraff, Witkin 1998), with Rayleigh damping. With K =
/// df/dx, B = df/dv:
///   ((1 + h rM) M - h B - h (h + rK) K) dv = h (f - rM M v + (h + rK) K v),   v += dv,   x += h v
struct EulerImplicitSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "EulerImplicitSolver";
  static constexpr bool implicit = true;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  double rayleighStiffness = 0;
  double rayleighMass = 0;

  static constexpr auto fields() {
    using S = EulerImplicitSolver;
    return field_list(
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative));
  }

  template <class Operations>
  void solve(Operations& operations, double h) const {
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force),
        dv(operations, vec_id::dx);
    MultiVecDeriv b(operations);
    operations.computeForce(force.id, pos.id, vel.id);
    b.eq(force);
    operations.addMBKdx(b.id, vel.id, {.m = -rayleighMass, .k = h + rayleighStiffness});
    b.teq(h);
    operations.projectResponse(b.id);
    operations.root.withLinearSolver([&](auto& linear) {
      linear.solve(
          operations, {.m = 1 + h * rayleighMass, .b = -h, .k = -h * (h + rayleighStiffness)}, dv, b);
    });
    vel.peq(dv);
    pos.peq(vel, h);
  }
};

}  // namespace sinew
