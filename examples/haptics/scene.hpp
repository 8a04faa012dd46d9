// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>

#include <sinew/control/hand_device.hpp>
#include <sinew/control/haptic_controller.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "options.hpp"

#include <cmath>

namespace examples {

/// Where the tool stands at the start: its tip on the middle of the top of the block, of 0.1 m.
inline sinew::Rigid3d::Coord tool_start() { return {{0, 0.15, 0}, {1, 0, 0, 0}}; }

/// A soft block on a table, and a rigid tool that stands on it, tied by its tip to the points around: what
/// the tip touches gives way. The tool, of 50 g, is drawn by a VirtualCoupling to where the device is.
inline auto haptic_scene(HapticOptions const& options) {
  using namespace sinew;
  const Mesh block = regular_grid_tetrahedra(
      options.cells + 1, options.cells + 1, options.cells + 1, {-0.05, 0, -0.05}, {0.05, 0.1, 0.05});
  const Eigen::Vector3d tip(0, -0.05, 0), contact = tool_start().center + tip;
  std::vector<int> table;
  std::vector<Spring> grip;
  for (std::size_t i = 0; i < block.positions.size(); ++i) {
    auto const& p = block.positions[i];
    if (p.y() < 1e-9) table.push_back(int(i));
    if (const double d = (p - contact).norm(); d > 1e-9 && d < 0.018)
      grip.push_back({.first = int(i), .second = 0, .stiffness = 60, .damping = 0.2, .length = d});
  }
  // a rod of 0.1 m along y: m l^2 / 12 across, and thin
  const RigidMass<double, 3> rod{0.05, Eigen::Vector3d(4.2e-5, 1e-5, 4.2e-5).asDiagonal().toDenseMatrix()};
  return Simulation{node<"root">(
      Gravity{{0, 0, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.02, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = options.iterations, .tolerance = 1e-6},
      StiffSpringForceField<Vec3d, Between<"block", "tool/tip">>{.springs = grip},
      node<"block">(TetrahedronTopology{block.tetrahedra},
                    MechanicalObject<Vec3d>{block.positions},
                    DiagonalMass<Vec3d>{.massDensity = 1000},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {options.youngModulus},
                                                    .poissonRatio = options.poissonRatio},
                    FixedConstraint<Vec3d>{.indices = table}),
      node<"tool">(MechanicalObject<Rigid3d>{.position = {tool_start()}},
                   UniformMass<Rigid3d>{.vertexMass = rod},
                   VirtualCoupling<Rigid3d>{},
                   node<"tip">(MechanicalObject<Vec3d>{.position = {tip}}, RigidMapping<Rigid3d, Vec3d>{})))};
}

/// One step of the scene with the device where `target` says: where the tool is then.
template <class Sim>
sinew::ToolState haptic_step(Sim& sim, sinew::ToolTarget const& target, double dt) {
  using namespace sinew;
  auto& tool = sim.template at<"tool">();
  tool.template get<VirtualCoupling<Rigid3d>>().follow(target.pose, target.velocity);
  sim.animate(dt);
  return {tool.state().position[0], tool.state().velocity[0]};
}

/// What the hand does: it presses the tool 15 mm in and lets it come back, 0.7 times a second, while it moves
/// to and fro by 10 mm and turns it.
struct Palpation {
  sinew::Rigid3d::Coord operator()(double time) const {
    const double start = std::min(time, 1.0);  // gently
    sinew::Rigid3d::Coord pose = tool_start();
    sinew::Rigid3d::Deriv d;
    d << 0.01 * std::sin(2 * time), -0.0075 * (1 - std::cos(4.4 * time)), 0.01 * std::sin(1.3 * time),
        0.2 * std::sin(1.7 * time), 0.3 * std::sin(time), 0;
    sinew::Rigid3d::increment(pose, start * d);
    return pose;
  }
};

}  // namespace examples
