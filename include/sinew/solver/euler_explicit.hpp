// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// The explicit method of Euler, order 1. Symplectic: v += a dt, then x += v dt with the new velocity
/// (Stoermer-Verlet's first order kin, energy stays bounded; bodies that rotate have the gyroscopic torque of
/// the end of the step, which adds no energy). Otherwise both use the old values. a = M^-1 f: where M is not
/// diagonal, as that of MeshMatrixMass or with masses of mapped states, the linear solver in reach finds it;
/// without one it is taken with the sums of the rows of M, and without those masses.
struct EulerExplicitSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "EulerExplicitSolver";
  static constexpr std::string_view aliases =
      "EulerSolver Euler EulerExplicit ExplicitEuler ExplicitEulerSolver EulerExplicitIntegrationScheme";
  static constexpr bool implicit = false, solvesMass = true;
  static constexpr int convergenceOrder = 1;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  bool symplectic = true;

  static constexpr auto fields() {
    return field_list(
        field("symplectic", &EulerExplicitSolver::symplectic, "", "move positions with the new velocity"));
  }

  template <class Operations>
  void solve(Operations& operations, double dt) const {
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force), acc(operations);
    operations.computeForce(force.id, pos.id, vel.id, symplectic ? dt : 0);
    operations.acted.add(force.id);
    if (!solveMass(operations, acc, force)) operations.accFromF(acc.id, force.id, pos.id);
    if (symplectic) {
      vel.peq(acc, dt);
      pos.peq(vel, dt);
    } else {
      pos.peq(vel, dt);
      vel.peq(acc, dt);
    }
  }

 private:
  // P M P a = P f by the linear solver; false where there is none, or nothing to solve
  template <class Operations>
  static bool solveMass(Operations& operations, MultiVecDeriv<Operations>& acc,
                        MultiVecDeriv<Operations> const& force) {
    if (operations.massIsDiagonal()) return false;
    MultiVecDeriv a(operations, vec_id::dx);  // from which the next solution may start
    acc.eq(force);
    operations.projectResponse(acc.id);
    const bool solved = operations.solveSystemIfAny({.m = 1}, a, acc);
    if (solved) acc.eq(a);
    return solved;
  }
};

}  // namespace sinew
