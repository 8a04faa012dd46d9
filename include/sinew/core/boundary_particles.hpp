// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>

#include <concepts>
#include <vector>

namespace sinew {

/// The boundary particles of all bodies that a fluid meets (Akinci, Ihmsen, Akinci, Solenthaler, Teschner
/// 2012), at the start of a step, and what the fluid does to them: its mean force over the step [N].
struct BoundaryParticles {
  std::vector<Eigen::Vector3d> positions{}, velocities{}, forces{};

  std::size_t size() const { return positions.size(); }
  void clear() {
    for (auto* v : {&positions, &velocities, &forces}) v->clear();
  }
};

/// A component that moves a fluid, or has its forces, and meets bodies: each step it is given their
/// particles.
template <class C>
concept MeetsBoundaries = requires(C c) {
  { c.boundary } -> std::same_as<BoundaryParticles&>;
};
/// A component whose points are boundary particles of a body: it is given the forces of fluids on them.
template <class C>
concept BoundsFluids = requires {
  requires C::boundsFluids;
  typename C::DataTypes;
};

}  // namespace sinew
