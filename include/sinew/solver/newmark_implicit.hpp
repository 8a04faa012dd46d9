// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <cmath>

namespace sinew {

/// Newmark's method (1959), linearised once a step, with Rayleigh damping; order 2 for gamma = 1/2, else 1,
/// and 1 for rigid bodies that rotate, whose gyroscopic forces have no part in the tangent. With a the
/// acceleration at the start of the step and a1 that at its end,
///   x1 = x + h v + h^2 ((1/2 - beta) a + beta a1),   v1 = v + h ((1 - gamma) a + gamma a1),
///   M a1 = f(x1, v1) - rM M v1 + rK K v1
/// beta = 1/4, gamma = 1/2 keeps the energy of linear systems. a is the a1 of the step before; in the first
/// step, and after a reset or a jump in time, it solves M a = f - rM M v + rK K v.
struct NewmarkImplicitSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "NewmarkImplicitSolver";
  static constexpr bool implicit = true;
  static constexpr int convergenceOrder = 2;
  static constexpr Auxiliary auxiliary{.derivs = 2};
  /// The first auxiliary deriv, a, keeps its value from step to step.
  static constexpr Auxiliary history{.derivs = 1};

  double rayleighStiffness = 0;
  double rayleighMass = 0;
  double vdamping = 0;
  double gamma = 0.5;
  double beta = 0.25;

  static constexpr auto fields() {
    using S = NewmarkImplicitSolver;
    return field_list(
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative),
        field("vdamping", &S::vdamping, "1/s", "rate at which velocities decay", range::nonNegative)
            .also("velocityDamping"),
        field("gamma", &S::gamma, "", "share of the new acceleration in the velocity", range::closed(0, 1)),
        field("beta", &S::beta, "", "share of the new acceleration in the position", range::closed(0, 0.5)));
  }

  double lastEnd = -1;  // time at the end of the step that a belongs to

  /// What the next step depends on, besides positions, velocities and `history`.
  static constexpr auto state() {
    return field_list(
        field("lastEnd", &NewmarkImplicitSolver::lastEnd, "s", "time at the end of the last step"));
  }
  void reset() { lastEnd = -1; }

  ConstraintFactors constraintFactors(double h) const {
    const double now = h * gamma;
    return {{.m = 1 + now * rayleighMass, .b = -now, .k = -h * h * beta - now * rayleighStiffness},
            1,
            h * h * beta,
            now};
  }
  /// The acceleration that the next step begins with has the part of the multipliers.
  template <class Operations>
  void corrected(Operations& operations, DerivId u, bool /*ofVelocity*/) const {
    operations.peq(DerivId{DerivId::reserved}, u, 1);
  }

  template <class Operations>
  void solve(Operations& operations, double h) {
    MultiVecDeriv a(operations), move(operations);
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), b(operations, vec_id::force), a1(operations, vec_id::dx);
    const double rK = rayleighStiffness, rM = rayleighMass, old = h * (1 - gamma), now = h * gamma;
    operations.computeForce(b.id, pos.id, vel.id);
    operations.acted.add(b.id);
    if (rM != 0 || rK != 0) operations.addMBKdx(b.id, vel.id, {.m = -rM, .k = rK});
    auto solveFor = [&](auto& x, MatrixFactors factors) {
      operations.projectResponse(b.id);
      operations.solveSystem(factors, x, b);
    };
    if (lastEnd != operations.time) solveFor(a, {.m = 1});

    // what the force changes by K (x1 - x) + B (v1 - v), as far as a1 has no part in it
    move.eq(vel, h);
    move.peq(a, h * h * (0.5 - beta));
    operations.addMBKdx(b.id, move.id, {.k = 1});
    operations.addMBKdx(b.id, a.id, {.m = -old * rM, .b = old, .k = old * rK});
    solveFor(a1, constraintFactors(h).matrix);
    move.peq(a1, h * h * beta);
    // the forces at the end of the step, with which M a1 is in balance
    operations.acted.add(move.id, {.k = 1});
    operations.acted.add(a.id, {.b = old});
    operations.acted.add(a1.id, {.b = now});
    operations.acted.balance(a1.id, 1 / h, 1 / h);
    pos.peq(move);
    vel.peq(a, old);
    vel.peq(a1, now);
    if (rM != 0 || rK != 0) operations.acted.add(vel.id, {.m = -rM, .k = rK});
    a.eq(a1);
    lastEnd = operations.time + h;
    if (vdamping != 0) vel.teq(std::exp(-h * vdamping));
  }
};

}  // namespace sinew
