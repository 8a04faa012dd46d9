// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>

#include <sinew/control/hand_device.hpp>
#include <sinew/control/haptic_controller.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "options.hpp"

#include <cmath>

namespace examples {

/// The tip of the tool is a ball of this radius, this far from the middle of the tool [m].
constexpr double tipRadius = 0.008, tipDistance = 0.05;
/// Of the tip from the block at the start, and below which they push each other [m].
constexpr double startDistance = 0.005, contactDistance = 0.001;

/// Where the tool stands at the start: upright, its tip above the middle of the top of the block, of 0.1 m.
inline sinew::Rigid3d::Coord tool_start() {
  return {{0, 0.1 + startDistance + tipRadius + tipDistance, 0}, {1, 0, 0, 0}};
}

/// A soft block on a table, and a rigid tool, free but for two forces: that of a VirtualCoupling, which draws
/// it to where the device is, and that of the contact of its tip with the skin of the block. One solver has
/// the two bodies, so that the contact is as implicit as all else.
inline auto haptic_scene(HapticOptions const& options) {
  using namespace sinew;
  const Mesh block = regular_grid_tetrahedra(
      options.cells + 1, options.cells + 1, options.cells + 1, {-0.05, 0, -0.05}, {0.05, 0.1, 0.05});
  std::vector<int> table;
  for (std::size_t i = 0; i < block.positions.size(); ++i)
    if (block.positions[i].y() < 1e-9) table.push_back(int(i));
  // the stiffness of a contact is the product of the two models' over its reach
  const double reach = contactDistance + tipRadius;
  // a rod of 0.1 m along y: m l^2 / 12 across, and thin
  const RigidMass<double, 3> rod{0.05, Eigen::Vector3d(4.2e-5, 1e-5, 4.2e-5).asDiagonal().toDenseMatrix()};
  return Simulation{node<"root">(
      Gravity{{0, 0, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.004, .contactDistance = contactDistance},
      DefaultContactManager{.capacity = 100},
      EulerImplicitSolver{.rayleighStiffness = 0.02, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = options.iterations, .tolerance = 1e-6},
      node<"block">(TetrahedronTopology{block.tetrahedra},
                    MechanicalObject<Vec3d>{block.positions},
                    DiagonalMass<Vec3d>{.massDensity = 1000},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {options.youngModulus},
                                                    .poissonRatio = options.poissonRatio},
                    FixedConstraint<Vec3d>{.indices = table},
                    TriangleCollisionModel<Vec3d>{.bothSide = false,
                                                  .contactStiffness = options.contactStiffness,
                                                  .contactFriction = options.friction}),
      node<"tool">(
          MechanicalObject<Rigid3d>{.position = {tool_start()}},
          UniformMass<Rigid3d>{.vertexMass = rod},
          VirtualCoupling<Rigid3d>{},
          node<"tip">(MechanicalObject<Vec3d>{.position = {{0, -tipDistance, 0}}},
                      RigidMapping<Rigid3d, Vec3d>{},
                      SphereCollisionModel<Vec3d>{.contactStiffness = reach, .radius = tipRadius})))};
}

/// What the block pushed the tip with, over the last step [N].
template <class Sim>
Eigen::Vector3d contact_force(Sim& sim) {
  // the skin of the block is the first surface of the scene, the tip the second
  Eigen::Vector3d f(0, 0, 0);
  for (sinew::Contact const& c : sim.root().template get<sinew::DefaultContactManager>().contacts)
    f += c.b.surface == 1 ? c.force : Eigen::Vector3d(-c.force);
  return f;
}

/// One step of the scene with the device where `target` says: where the tool is then.
template <class Sim>
sinew::ToolState haptic_step(Sim& sim, sinew::ToolTarget const& target, double dt) {
  using namespace sinew;
  auto& tool = sim.template at<"tool">();
  tool.template get<VirtualCoupling<Rigid3d>>().setTarget(target.pose, target.velocity);
  sim.animate(dt);
  return {tool.state().position[0], tool.state().velocity[0]};
}

/// What the hand does: 0.7 times a second it presses the tip 15 mm into the block and lifts it off again, by
/// 5 mm, while it moves to and fro by 10 mm and turns the tool.
struct Palpation {
  sinew::Rigid3d::Coord operator()(double time) const {
    const double start = std::min(time, 1.0);  // gently
    sinew::Rigid3d::Coord pose = tool_start();
    sinew::Rigid3d::Deriv d;
    d << 0.01 * std::sin(2 * time), -0.01 * (1 - std::cos(4.4 * time)), 0.01 * std::sin(1.3 * time),
        0.2 * std::sin(1.7 * time), 0.3 * std::sin(time), 0;
    sinew::Rigid3d::increment(pose, start * d);
    return pose;
  }
};

}  // namespace examples
