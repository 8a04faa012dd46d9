// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <cmath>

namespace sinew {

/// Implicit Euler, order 1, linearised once a step (Baraff, Witkin 1998), with Rayleigh damping. With K =
/// df/dx, B = df/dv, and t = 1:
///   ((1 + t h rM) M - t h B - t h (t h + rK) K) dv = h (f - rM M v + (t h + rK) K v),   v1 = v + dv,
///   x1 = x + h (v + t dv)
/// `trapezoidalScheme` has t = 1/2: the trapezoidal rule, which does not damp, of order 2 for
/// points. (SOFA moves positions
/// by h v1 in that case too, and so has order 1.) `firstOrder` is for bodies without inertia, M v = f(x),
/// such as those in a thick fluid: (M - t h K) v1 = f, with M in the place of a viscosity.
struct EulerImplicitSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "EulerImplicitSolver";
  static constexpr std::string_view aliases =
      "EulerImplicit ImplicitEulerSolver ImplicitEuler EulerImplicitIntegrationScheme";
  static constexpr bool implicit = true;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  double rayleighStiffness = 0;
  double rayleighMass = 0;
  double vdamping = 0;
  bool firstOrder = false;
  bool trapezoidalScheme = false;

  static constexpr auto fields() {
    using S = EulerImplicitSolver;
    return field_list(
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative),
        field("vdamping", &S::vdamping, "1/s", "rate at which velocities decay", range::nonNegative)
            .also("velocityDamping"),
        field("firstOrder", &S::firstOrder, "", "solve M v = f(x)"),
        field("trapezoidalScheme", &S::trapezoidalScheme, "", "take the trapezoidal rule"));
  }

  template <class Operations>
  void solve(Operations& operations, double h) const {
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force),
        dv(operations, vec_id::dx);
    MultiVecDeriv b(operations);
    operations.computeForce(force.id, pos.id, vel.id);
    b.eq(force);
    const double t = trapezoidalScheme ? 0.5 : 1, rK = rayleighStiffness, rM = rayleighMass;
    if (!firstOrder) {
      operations.addMBKdx(b.id, vel.id, {.m = -rM, .k = t * h + rK});
      b.teq(h);
    }
    operations.projectResponse(b.id);
    MatrixFactors factors{.m = 1 + t * h * rM, .b = -t * h, .k = -t * h * (t * h + rK)};
    if (firstOrder) factors = {.m = 1, .k = -t * h};
    operations.root.withLinearSolver([&](auto& linear) { linear.solve(operations, factors, dv, b); });
    if (firstOrder) {
      vel.eq(dv);
      pos.peq(vel, h);
    } else if (trapezoidalScheme) {
      vel.peq(dv, 0.5);
      pos.peq(vel, h);
      vel.peq(dv, 0.5);
    } else {
      vel.peq(dv);
      pos.peq(vel, h);
    }
    if (vdamping != 0) vel.teq(std::exp(-h * vdamping));
  }
};

}  // namespace sinew
