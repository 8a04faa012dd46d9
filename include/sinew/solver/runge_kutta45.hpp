// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <cmath>

namespace sinew {

/// Runge-Kutta method of order 5 with an estimate of its error of order 4 (Dormand, Prince 1980), which
/// divides the step of the scene into substeps of an error
///   sqrt(|e_x|^2 + h^2 |e_v|^2) <= tolerance         [m], over all points
/// each. Rotations are advanced as in RungeKutta4Solver.
struct RungeKutta45Solver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "RungeKutta45Solver";
  static constexpr bool implicit = false;
  static constexpr int convergenceOrder = 5;
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 16};

  double tolerance = 1e-6;
  int maxSubsteps = 1000;

  static constexpr auto fields() {
    using S = RungeKutta45Solver;
    return field_list(
        field(
            "tolerance", &S::tolerance, "m", "error of a substep; 0: one substep a step", range::nonNegative),
        field("maxSubsteps",
              &S::maxSubsteps,
              "",
              "a substep is never shorter than the step divided by this",
              range::atLeast(1)));
  }

  double next = 0;  // substep to try first; 0: the whole step [s]
  int substeps = 0, rejected = 0,
      rough = 0;  // of the last step: taken, tried in vain, shortest and yet too rough

  /// What the next step depends on, besides positions and velocities.
  static constexpr auto state() {
    return field_list(field("next", &RungeKutta45Solver::next, "s", "substep to try first"));
  }
  void reset() { next = 0; }

  template <class Operations>
  void solve(Operations& operations, double dt) {
    using Deriv = MultiVecDeriv<Operations>;
    MultiVecCoord pos(operations, vec_id::position), newX(operations);
    Deriv vel(operations, vec_id::velocity), newV(operations), theta(operations);
    Deriv k[7]{Deriv(operations),
               Deriv(operations),
               Deriv(operations),
               Deriv(operations),
               Deriv(operations),
               Deriv(operations),
               Deriv(operations)};
    Deriv acc[7]{Deriv(operations),
                 Deriv(operations),
                 Deriv(operations),
                 Deriv(operations),
                 Deriv(operations),
                 Deriv(operations),
                 Deriv(operations)};
    static constexpr double time[] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
    // row 6 is the solution of order 5, whose last stage is the first of the next substep
    static constexpr double weight[7][6] = {
        {},
        {1. / 5},
        {3. / 40, 9. / 40},
        {44. / 45, -56. / 15, 32. / 9},
        {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
        {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
        {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
    static constexpr double error[] = {
        71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

    const double start = operations.time, shortest = dt / maxSubsteps;
    substeps = rejected = rough = 0;
    if (!(next > 0) || tolerance == 0) next = dt;
    operations.computeAcc(start, acc[0], pos, vel);
    for (double done = 0; done < dt;) {
      const bool last = done + next >= dt * (1 - 1e-9);
      const double h = last ? dt - done : next;
      // the last evaluation is that of stage 0
      operations.acted.mark();
      operations.acted.add(vec_id::force, weight[6][0] * h / dt);
      k[0].eq(vel);
      for (int stage = 1; stage < 7; ++stage) {
        theta.clear();
        newV = vel;
        for (int i = 0; i < stage; ++i)
          if (const double w = h * weight[stage][i]; w != 0) {
            theta.peq(k[i], w);
            newV.peq(acc[i], w);
          }
        newX = pos;
        newX.peq(theta);
        operations.computeAcc(start + done + time[stage] * h, acc[stage], newX, newV);
        if (stage < 6 && weight[6][stage] != 0)
          operations.acted.add(vec_id::force, weight[6][stage] * h / dt);
        operations.chartRate(k[stage].id, theta.id, newV.id);
      }
      double estimate = 0;
      if (tolerance > 0) {
        // theta has served, and takes the two errors one after the other
        for (auto* rates : {k, acc}) {
          theta.clear();
          for (int i = 0; i < 7; ++i)
            if (error[i] != 0) theta.peq(rates[i], h * error[i]);
          estimate = std::hypot(estimate, rates == k ? theta.norm() : h * theta.norm());
        }
      }
      // an error of order h^5 would be the tolerance at h (tolerance / error)^(1/5)
      double factor = estimate == 0 ? 5 : 0.9 * std::pow(tolerance / estimate, 0.2);
      factor = std::isfinite(factor) ? std::clamp(factor, 0.2, 5.0) : 0.2;
      const double wanted = tolerance > 0 ? std::clamp(h * factor, shortest, dt) : dt;
      if (!(estimate <= tolerance) && h > shortest * (1 + 1e-9)) {
        ++rejected;
        next = wanted;
        operations.acted.takeBack();
        if (operations.acted.asked()) operations.computeAcc(start + done, acc[0], pos, vel);
        continue;
      }
      ++substeps;
      if (!(estimate <= tolerance)) ++rough;
      if (h > 0.999 * next || wanted > next) next = wanted;  // a last one cut short says nothing less
      pos = newX;
      vel = newV;
      acc[0] = acc[6];
      done = last ? dt : done + h;
    }
    operations.time = start;
  }
};

}  // namespace sinew
