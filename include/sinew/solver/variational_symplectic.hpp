// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// The implicit midpoint rule, order 2, symplectic: energy stays bounded over any time, momentum is kept (the
/// variational integrator of Kharevych et al. 2006). With d = h/2 w the displacement to the middle of the
/// step, w = (x1 - x) / h and forces and masses taken there,
///   M (w - v) 2/h = f(x + d, w) - rM M w + rK K w,   x1 = x + 2 d,   v1 = 2 w - v
/// is solved for d by Newton's method. Its first iteration alone has the order for points, the second for
/// rigid bodies too. `explicitIntegration` takes symplectic Euler instead, of order 1.
struct VariationalSymplecticSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "VariationalSymplecticSolver";
  static constexpr bool implicit = true;
  static constexpr int convergenceOrder = 2;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 3};

  double newtonError = 0.01;
  int steps = 5;
  double rayleighStiffness = 0;
  double rayleighMass = 0;
  bool explicitIntegration = false;

  static constexpr auto fields() {
    using S = VariationalSymplecticSolver;
    return field_list(
        field("newtonError",
              &S::newtonError,
              "",
              "correction at which Newton's method stops, relative to the displacement of the step",
              range::nonNegative),
        field("steps", &S::steps, "", "largest number of iterations of Newton's method", range::atLeast(1)),
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative),
        field("explicitIntegration", &S::explicitIntegration, "", "take symplectic Euler"));
  }

  int iterations = 0;  // of Newton's method in the last step

  ConstraintFactors constraintFactors(double h) const {
    if (explicitIntegration) return {{.m = 1}, h, h, 1};
    return {{.m = 4 / (h * h) + 2 * rayleighMass / h, .b = -2 / h, .k = -1 - 2 * rayleighStiffness / h},
            1,
            2,
            4 / h};
  }

  template <class Operations>
  void solve(Operations& operations, double h) {
    MultiVecCoord pos(operations, vec_id::position), start(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), b(operations, vec_id::force), dx(operations, vec_id::dx);
    MultiVecDeriv d(operations), w(operations), change(operations);
    if (explicitIntegration) {
      operations.computeForce(b.id, pos.id, vel.id);
      operations.acted.add(b.id);
      if (rayleighMass != 0) operations.acted.add(vel.id, {.m = -rayleighMass});
      if (rayleighMass != 0) operations.addMBKdx(b.id, vel.id, {.m = -rayleighMass});
      operations.accFromF(dx.id, b.id, pos.id);
      vel.peq(dx, h);
      pos.peq(vel, h);
      return;
    }

    // positions are those of the middle while forces, tangents and masses are asked for
    const double rK = rayleighStiffness, rM = rayleighMass;
    start = pos;
    d.eq(vel, h / 2);
    const double time = operations.time;
    operations.time = time + h / 2;
    for (iterations = 1;; ++iterations) {
      pos = start;
      pos.peq(d);
      w.eq(d, 2 / h);
      operations.propagate(pos.id, w.id);
      operations.computeForce(b.id, pos.id, w.id);
      operations.acted.clear();
      operations.acted.add(b.id);
      change.eq(vel, 2 / h);
      change.peq(w, -2 / h);
      operations.addMBKdx(b.id, change.id, {.m = 1});
      if (rM != 0 || rK != 0) operations.addMBKdx(b.id, w.id, {.m = -rM, .k = rK});
      operations.projectResponse(b.id);
      operations.solveSystem(constraintFactors(h).matrix, dx, b);
      d.peq(dx);
      if (iterations >= steps || !(dx.norm() > newtonError * d.norm())) break;
    }
    w.eq(d, 2 / h);
    operations.acted.add(dx.id, {.b = 2 / h, .k = 1});
    if (rM != 0 || rK != 0) operations.acted.add(w.id, {.m = -rM, .k = rK});
    operations.time = time;
    pos = start;
    pos.peq(d, 2);
    vel.teq(-1);
    vel.peq(d, 4 / h);
  }
};

}  // namespace sinew
