// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

namespace sinew {

/// Name of a state vector. The same id means the same quantity in every MechanicalObject of a scene; ids from
/// `reserved` on are auxiliary vectors, which solvers take from a pool.
struct CoordId {
  int index;
  static constexpr int reserved = 3;
  friend constexpr bool operator==(CoordId, CoordId) = default;
};
struct DerivId {
  int index;
  static constexpr int reserved = 8;
  friend constexpr bool operator==(DerivId, DerivId) = default;
};

namespace vec_id {
inline constexpr CoordId position{0}, restPosition{1}, freePosition{2};
inline constexpr DerivId velocity{0}, force{1}, dx{2}, externalForce{3};
// of Simulation::keepForces
inline constexpr DerivId applied{4}, reaction{5}, startVelocity{6}, marked{7};
}  // namespace vec_id

/// How many auxiliary vectors a solver takes from the pool at the same time.
struct Auxiliary {
  int coords = 0, derivs = 0;
  friend constexpr Auxiliary operator+(Auxiliary a, Auxiliary b) {
    return {a.coords + b.coords, a.derivs + b.derivs};
  }
};

}  // namespace sinew
