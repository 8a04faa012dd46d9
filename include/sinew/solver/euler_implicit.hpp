// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/solver/newton.hpp>

namespace sinew {

/// Implicit Euler, order 1 (Baraff, Witkin 1998), with Rayleigh damping. With K = df/dx, B = df/dv, and t =
/// 1:
///   M dv = h (f(xt, vt) - rM M vt + rK K vt),   vt = v + t dv,   xt = x + t h vt,
///   v1 = v + dv,   x1 = x + h vt
/// is solved for dv by Newton's method from xt = x, vt = v. Its first iteration alone, the default, is the
/// step linearised (with the gyroscopic torque that bodies have at its end, which adds no energy):
///   ((1 + t h rM) M - t h B - t h (t h + rK) K) dv = h (f(x, v) - rM M v + (t h + rK) K v)
/// `trapezoidalScheme` has t = 1/2: the trapezoidal rule where f is linear, the midpoint rule with more
/// iterations; it does not damp, and has order 2 for points. (SOFA moves positions by h v1 in that case too,
/// and so has order 1.) `firstOrder` is for bodies without inertia, M vt = f(xt), such as those in a thick
/// fluid: (M - t h K) vt = f, with M in the place of a viscosity; v1 = vt.
struct EulerImplicitSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "EulerImplicitSolver";
  static constexpr std::string_view aliases =
      "EulerImplicit ImplicitEulerSolver ImplicitEuler EulerImplicitIntegrationScheme";
  static constexpr bool implicit = true;
  static constexpr int convergenceOrder = 1;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 3};

  double rayleighStiffness = 0;
  double rayleighMass = 0;
  double vdamping = 0;
  bool firstOrder = false;
  bool trapezoidalScheme = false;
  int maxNbIterationsNewton = 1;
  double relativeSuccessiveStoppingThreshold = 0, relativeInitialStoppingThreshold = 1e-5,
         absoluteResidualStoppingThreshold = 0, relativeEstimateDifferenceThreshold = 0,
         absoluteEstimateDifferenceThreshold = 0;
  bool shouldDivergeWhenResidualIsGrowing = false;
  int maxNbIterationsLineSearch = 0;
  double lineSearchCoefficient = 0.5;

  static constexpr auto fields() {
    using S = EulerImplicitSolver;
    return newton_fields<S>(
        "N s",
        "m/s",
        field("rayleighStiffness", &S::rayleighStiffness, "s", "damping per stiffness", range::nonNegative),
        field("rayleighMass", &S::rayleighMass, "1/s", "damping per mass", range::nonNegative),
        field("vdamping", &S::vdamping, "1/s", "rate at which velocities decay", range::nonNegative)
            .also("velocityDamping"),
        field("firstOrder", &S::firstOrder, "", "solve M v = f(x)"),
        field("trapezoidalScheme", &S::trapezoidalScheme, "", "take the trapezoidal rule"));
  }

  NewtonReport newton{};

  ConstraintFactors constraintFactors(double h) const {
    const double t = trapezoidalScheme ? 0.5 : 1;
    if (firstOrder) return {{.m = 1, .k = -t * h}, 1, h, 1};
    return {
        {.m = 1 + t * h * rayleighMass, .b = -t * h, .k = -t * h * (t * h + rayleighStiffness)}, h, t * h, 1};
  }

  template <class Operations>
  void init(Operations&) {
    newton.init(maxNbIterationsNewton);
  }

  template <class Operations>
  void solve(Operations& operations, double h) {
    MultiVecCoord pos(operations, vec_id::position), start(operations);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force),
        dv(operations, vec_id::dx);
    MultiVecDeriv b(operations), startV(operations), increment(operations);
    const double t = trapezoidalScheme ? 0.5 : 1, rK = rayleighStiffness, rM = rayleighMass,
                 time = operations.time;
    const bool again = newton_goes_on(*this);
    if (again) start = pos, startV = vel;
    // from the start of the step with vt for a time; `increment` is dv, or vt where the order is the first
    auto go = [&](double far) {
      if (again) pos = start, vel = startV;
      if (firstOrder)
        vel = increment;
      else
        vel.peq(increment, t);
      pos.peq(vel, far);
    };
    auto evaluate = [&] {
      const bool first = newton.residuals.empty();  // x and v are still those of the start
      if (!first) {
        go(t * h);
        operations.time = time + t * h;
        operations.projectPositionAndVelocity(operations.time, pos.id, vel.id);
        operations.propagate(pos.id, vel.id);
      }
      operations.computeForce(force.id, pos.id, vel.id, again || t != 1 ? 0 : h);
      b.eq(force);
      if (!firstOrder) {
        operations.addMBKdx(b.id, vel.id, {.m = -rM, .k = first ? t * h + rK : rK});
        b.teq(h);
      }
      if (!first) operations.addMBKdx(b.id, increment.id, {.m = -1});
      operations.projectResponse(b.id);
    };
    const MatrixFactors factors = constraintFactors(h).matrix;
    sinew::newton(*this,
                  operations,
                  {.factors = factors, .dx = dv, .b = b, .increment = increment},
                  NewtonCallbacks{evaluate, [](double) {}});
    // what acted is f at (xt, vt), of which the first iteration alone knows the linear part
    operations.acted.add(force.id);
    if (firstOrder) {
      if (!again) operations.acted.add(increment.id, {.k = t * h});
      operations.acted.balance(increment.id, 1, 0);
    } else {
      operations.acted.add(vel.id, {.m = -rM, .k = again ? rK : t * h + rK}, true);
      if (!again) operations.acted.add(increment.id, {.m = -t * rM, .b = t, .k = t * (t * h + rK)});
    }
    operations.time = time;
    go(h);
    if (!firstOrder && t != 1) vel.peq(increment, 1 - t);
    if (vdamping != 0) vel.teq(std::exp(-h * vdamping));
  }
};

}  // namespace sinew
