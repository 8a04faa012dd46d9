// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/solver/newton.hpp>

namespace sinew {

/// Backward differentiation (Curtiss, Hirschfelder 1952) of order 1 to 3. Order 1 is implicit Euler, 2 is
/// stable for any stiffness, 3 is stable but for springs that hardly damp (angles of more than 86 degrees).
/// From what the state moved by in the steps before, dx- and dv-, dx-- and dv--, of the lengths h- and h--,
///   x1 = x + c dx- + d dx-- + B v1,   M (v1 - v - c dv- - d dv--) = B (f(x1, v1) - rM M v1 + rK K v1),
/// with B, c and d so that cubics x(t) are met exactly: with p = h + h-, q = h- + h--, s = p + h--,
///   1/B = 1/h + 1/p + 1/s,   c = B h/h- (1/p + (1 + p/q)/s),   d = -B h/h-- p/(q s)
/// For order 2, as in the second step, 1/s is 0; for order 1, as in the first step, so is 1/p. That would
/// cost order 3 its order: its first step is the trapezoidal rule. Newton's method solves for v1; its first
/// iteration alone already has the order for points, the second for rigid bodies too up to order 2, whose
/// gyroscopic forces have no part in the tangent. Multipliers act as f(x1, v1) does, and the history has what
/// they move.
struct BDFOdeSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "BDFOdeSolver";
  static constexpr std::string_view aliases = "BDF2OdeSolver BDF2";
  static constexpr bool implicit = true;
  static constexpr int convergenceOrder = 1;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 8};
  /// The first four auxiliary derivs, dx-, dv-, dx-- and dv--, keep their values from step to step.
  static constexpr Auxiliary history{.derivs = 4};

  int order = 1;
  double rayleighStiffness = 0;
  double rayleighMass = 0;
  int maxNbIterationsNewton = 1;
  double relativeSuccessiveStoppingThreshold = 0, relativeInitialStoppingThreshold = 1e-5,
         absoluteResidualStoppingThreshold = 0, relativeEstimateDifferenceThreshold = 0,
         absoluteEstimateDifferenceThreshold = 0;
  bool shouldDivergeWhenResidualIsGrowing = false;
  int maxNbIterationsLineSearch = 0;
  double lineSearchCoefficient = 0.5;

  static constexpr auto fields() {
    using S = BDFOdeSolver;
    return newton_fields<S>(
        "N s",
        "m/s",
        field("order", &S::order, "", "order of the method, 1 to 3", range::closed(1, 3)),
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative));
  }

  double lastDt = 0, olderDt = 0;  // of the steps that dx- and dx-- belong to; 0: there was none
  double lastEnd = 0;              // time at the end of the last step

  /// What the next step depends on, besides positions, velocities and `history`.
  static constexpr auto state() {
    using S = BDFOdeSolver;
    return field_list(field("lastDt", &S::lastDt, "s", "length of the last step"),
                      field("olderDt", &S::olderDt, "s", "length of the step before it"),
                      field("lastEnd", &S::lastEnd, "s", "time at the end of the last step"));
  }

  void reset() { lastDt = olderDt = lastEnd = weight = 0; }

  NewtonReport newton{};
  double weight = 0;  // B of the last step; 0: there was none

  ConstraintFactors constraintFactors(double h) const {
    const double b = weight > 0 ? weight : h;
    return {{.m = 1 + b * rayleighMass, .b = -b, .k = -b * (b + rayleighStiffness)}, b, b, 1};
  }
  /// Whether the first steps have others than those behind them.
  bool changesFactors() const { return order > 1; }
  /// dx- and dv- of the next step have the part of the multipliers.
  template <class Operations>
  void corrected(Operations& operations, DerivId u, bool ofVelocity) const {
    const DerivId dxOld{DerivId::reserved}, dvOld{DerivId::reserved + 1};
    operations.peq(dvOld, u, 1);
    if (ofVelocity) {
      operations.clear(dxOld);
      operations.peq(dxOld, vec_id::velocity, lastDt);
    } else {
      operations.peq(dxOld, u, weight);
    }
  }

  template <class Operations>
  void init(Operations&) {
    newton.init(maxNbIterationsNewton);
  }

  template <class Operations>
  void solve(Operations& operations, double h) {
    MultiVecDeriv dxOld(operations), dvOld(operations), dxOlder(operations), dvOlder(operations);
    MultiVecCoord pos(operations, vec_id::position), start(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), b(operations, vec_id::force), dv(operations, vec_id::dx);
    MultiVecDeriv startV(operations), move(operations), change(operations), increment(operations);
    const double rK = rayleighStiffness, rM = rayleighMass, time = operations.time;
    // after a reset, or a jump in time, the steps before are not those that are remembered
    if (lastEnd != time) lastDt = 0;
    if (lastDt == 0) olderDt = 0;
    double inverse = 1 / h, c = 0, d = 0;
    if (order > 1 && lastDt > 0) {
      const double p = h + lastDt;
      inverse += 1 / p;
      c = h / lastDt / p;
      if (order > 2 && olderDt > 0) {
        const double q = lastDt + olderDt, s = p + olderDt;
        inverse += 1 / s;
        c += h / lastDt * (1 + p / q) / s;
        d = -h / olderDt * p / (q * s);
      }
    }
    const bool trapezoid = order > 2 && lastDt == 0;
    const double bh = trapezoid ? h / 2 : 1 / inverse;
    c *= bh, d *= bh;
    weight = bh;
    // what acts are the forces at the end of the step, but for the mean of the trapezoidal rule
    const double part = trapezoid ? 0.5 : 1;
    auto rate = [&] {
      operations.computeForce(b.id, pos.id, vel.id);
      operations.acted.add(b.id, part);
      if (rM != 0 || rK != 0) operations.addMBKdx(b.id, vel.id, {.m = -rM, .k = rK});
    };
    auto damp = [&] {
      if (rM != 0 || rK != 0) operations.acted.add(vel.id, {.m = -rM * part, .k = rK * part});
    };
    if (trapezoid) {
      rate();
      damp();
      dvOlder.eq(b);
      dvOld.clear();
      dxOld.eq(vel, h);
      c = 0.5;
    }

    operations.acted.mark();
    start = pos;
    startV = vel;
    operations.time = time + h;
    auto go = [&] {
      move.eq(vel, bh);
      if (c != 0) move.peq(dxOld, c);
      if (d != 0) move.peq(dxOlder, d);
      pos = start;
      pos.peq(move);
      operations.propagate(pos.id, vel.id);
    };
    auto evaluate = [&] {
      go();
      operations.acted.takeBack();
      rate();
      if (trapezoid) b.peq(dvOlder);
      b.teq(bh);
      change.eq(startV);
      if (c != 0) change.peq(dvOld, c);
      if (d != 0) change.peq(dvOlder, d);
      change.peq(vel, -1);
      operations.addMBKdx(b.id, change.id, {.m = 1});
      operations.projectResponse(b.id);
    };
    sinew::newton(*this,
                  operations,
                  {.factors = constraintFactors(h).matrix, .dx = dv, .b = b, .increment = increment},
                  NewtonCallbacks{evaluate, [&](double s) { vel.peq(dv, s); }});
    if (!newton_goes_on(*this)) operations.acted.add(dv.id, {.b = part, .k = part * bh});
    damp();
    if (operations.acted.kept() && !trapezoid) {
      change.eq(vel, 1 / bh);
      change.peq(startV, -1 / bh);
      if (c != 0) change.peq(dvOld, -c / bh);
      if (d != 0) change.peq(dvOlder, -d / bh);
      operations.acted.balance(change.id, 1 / h, 1 / h);
    }
    if (!newton_goes_on(*this)) go();
    operations.time = time;
    dxOlder.eq(dxOld);
    dvOlder.eq(dvOld);
    dxOld.eq(move);
    dvOld.eq(vel);
    dvOld.peq(startV, -1);
    olderDt = lastDt;
    lastDt = h;
    lastEnd = time + h;
  }
};

}  // namespace sinew
