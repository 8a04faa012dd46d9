// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// Central differences (Stoermer, Verlet, leap-frog), explicit, order 2, symplectic without damping.
/// Velocities are those in the middle between two steps: v-, at t - h/2, before a step and v+, at t + h/2,
/// after it,
///   M (v+ - v-) / h = f(x) - rM M (v+ + v-) / 2,   x += h v+
/// so that the velocity given at the start is that at -h/2; to give the one at 0 costs half a step of delay.
/// Forces that read velocities get v-.
struct CentralDifferenceSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "CentralDifferenceSolver";
  static constexpr std::string_view aliases = "CentralDifference";
  static constexpr bool implicit = false;
  static constexpr int convergenceOrder = 2;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  double rayleighMass = 0;

  static constexpr auto fields() {
    return field_list(field("rayleighMass",
                            &CentralDifferenceSolver::rayleighMass,
                            "1/s",
                            "damping per mass",
                            range::nonNegative));
  }

  template <class Operations>
  void solve(Operations& operations, double h) const {
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), force(operations, vec_id::force), acc(operations);
    operations.computeForce(force.id, pos.id, vel.id);
    operations.acted.add(force.id);
    operations.accFromF(acc.id, force.id, pos.id);
    const double half = 0.5 * h * rayleighMass;
    auto addDamping = [&] {
      if (half != 0) operations.acted.add(vel.id, {.m = -rayleighMass / 2});
    };
    addDamping();
    if (half != 0) vel.teq((1 - half) / (1 + half));
    vel.peq(acc, h / (1 + half));
    addDamping();
    pos.peq(vel, h);
  }
};

}  // namespace sinew
