// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// Backward differentiation (Curtiss, Hirschfelder 1952) of order 2, or 1: implicit Euler; stable for any
/// stiffness, for steps of any size. From what the state moved by in the step before, dx- and dv-, with the
/// ratio r of the two steps,
///   x1 = x + c dx- + B h v1,   M (v1 - v - c dv-) = B h (f(x1, v1) - rM M v1 + rK K v1),
///   c = r^2 / (1 + 2 r), B = (1 + r) / (1 + 2 r)          c = 0, B = 1 in the first step and for order 1
/// is solved for v1 by Newton's method; its first iteration alone already has the order for
/// points, the second for rigid bodies too, whose gyroscopic forces have no part in the tangent.
struct BDFOdeSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "BDFOdeSolver";
  static constexpr std::string_view aliases = "BDF2OdeSolver BDF2";
  static constexpr bool implicit = true;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 5};
  /// The first two auxiliary derivs, dx- and dv-, keep their values from step to step.
  static constexpr Auxiliary history{.derivs = 2};

  int order = 2;
  double rayleighStiffness = 0;
  double rayleighMass = 0;
  int maxNbIterationsNewton = 1;
  double relativeInitialStoppingThreshold = 1e-5;

  static constexpr auto fields() {
    using S = BDFOdeSolver;
    return field_list(
        field("order", &S::order, "", "order of the method, 1 or 2", range::closed(1, 2)),
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative),
        field("maxNbIterationsNewton",
              &S::maxNbIterationsNewton,
              "",
              "largest number of iterations of Newton's method",
              range::atLeast(1)),
        field("relativeInitialStoppingThreshold",
              &S::relativeInitialStoppingThreshold,
              "",
              "residual at which Newton's method stops, against its first",
              range::nonNegative));
  }

  double lastDt = 0, lastEnd = 0;  // of the step that dx- and dv- belong to; lastDt = 0: there was none
  int iterations = 0;              // of Newton's method in the last step

  /// What the next step depends on, besides positions, velocities and `history`.
  static constexpr auto state() {
    using S = BDFOdeSolver;
    return field_list(field("lastDt", &S::lastDt, "s", "length of the last step"),
                      field("lastEnd", &S::lastEnd, "s", "time at its end"));
  }

  template <class Operations>
  void solve(Operations& operations, double h) {
    MultiVecDeriv dxOld(operations), dvOld(operations);
    MultiVecCoord pos(operations, vec_id::position), start(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), b(operations, vec_id::force), dv(operations, vec_id::dx);
    MultiVecDeriv startV(operations), move(operations), change(operations);
    const double rK = rayleighStiffness, rM = rayleighMass, time = operations.time;
    // after a reset, or a jump in time, the step before is not the one that is remembered
    const bool two = order == 2 && lastDt > 0 && lastEnd == time;
    const double ratio = two ? h / lastDt : 0, c = ratio * ratio / (1 + 2 * ratio),
                 bh = h * (1 + ratio) / (1 + 2 * ratio);
    if (!two) dxOld.clear(), dvOld.clear();

    start = pos;
    startV = vel;
    operations.time = time + h;
    double first = 0;
    for (iterations = 0;; ++iterations) {
      move.eq(vel, bh);
      move.peq(dxOld, c);
      pos = start;
      pos.peq(move);
      operations.propagate(pos.id, vel.id);
      if (iterations == maxNbIterationsNewton) break;
      operations.computeForce(b.id, pos.id, vel.id);
      if (rM != 0 || rK != 0) operations.addMBKdx(b.id, vel.id, {.m = -rM, .k = rK});
      b.teq(bh);
      change.eq(startV);
      change.peq(dvOld, c);
      change.peq(vel, -1);
      operations.addMBKdx(b.id, change.id, {.m = 1});
      operations.projectResponse(b.id);
      const double residual = b.norm();
      if (iterations == 0) first = residual;
      if (iterations > 0 && !(residual > relativeInitialStoppingThreshold * first)) break;
      operations.root.withLinearSolver([&](auto& linear) {
        linear.solve(operations, {.m = 1 + bh * rM, .b = -bh, .k = -bh * (bh + rK)}, dv, b);
      });
      vel.peq(dv);
    }
    operations.time = time;
    dxOld.eq(move);
    dvOld.eq(vel);
    dvOld.peq(startV, -1);
    lastDt = h;
    lastEnd = time + h;
  }
};

}  // namespace sinew
