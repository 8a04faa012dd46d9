// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <Eigen/Core>

#include <concepts>
#include <string>
#include <vector>

namespace sinew {

/// A solid that fluids on grids meet, at the start of a step: a closed surface, and how its body answers to
/// forces. Bodies in the plane have z = 0.
///   V = V* + R P     V = (v, w) around `centre`, P = (impulse, its moment) of the fluid
struct ImmersedBody {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  std::string path{};                            // for messages
  int dimension = 3;                             // of the space in which it is
  std::vector<std::array<Index, 3>> elements{};  // triangles, or in the plane edges with -1 at the end
  std::vector<Eigen::Vector3d> positions{}, velocities{};
  bool rigid = false;  // it moves as one rigid body
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Vector6 motion = Vector6::Zero();    // V*: at the end of the step, without the fluid
  Matrix6 response = Matrix6::Zero();  // R; 0 for what the fluid does not move

  // what the fluid does to it: its mean force over the step, on each point, and all together [N, N m]
  std::vector<Eigen::Vector3d> forces{};
  Vector6 load = Vector6::Zero();

  bool answers() const { return rigid && !response.isZero(0); }
};

/// A component that steps a fluid and meets solids: each step it is given them.
template <class C>
concept MeetsBodies = requires(C c) {
  { c.bodies } -> std::same_as<std::vector<ImmersedBody>&>;
};
/// A component over whose points the surface of a solid is.
template <class C>
concept ImmersesBody = requires(C c) {
  { c.body } -> std::same_as<ImmersedBody&>;
  typename C::DataTypes;
};

}  // namespace sinew
