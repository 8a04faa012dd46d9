// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace fem_bar {

using namespace sinew;

/// A cantilever of tetrahedra under gravity with implicit Euler, held at one end or free. `graded`: its
/// stiffness grows 1000 times along the bar, which diagonal scaling undoes.
template <class Linear>
auto simulation(Linear linear, int cells = 8, bool held = true, bool graded = false) {
  const Mesh mesh = regular_grid_tetrahedra(cells + 1, 3, 3, {0, 0, 0}, {double(cells) / 2, 1, 1});
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (held && mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
  std::vector<double> young(graded ? mesh.tetrahedra.size() : 1, 1e5);
  if (graded)
    for (std::size_t t = 0; t < young.size(); ++t)
      young[t] *= std::pow(1000.0, mesh.positions[std::size_t(mesh.tetrahedra[t][0])][0] / (cells / 2.0));
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                              linear,
                              TetrahedronTopology{mesh.tetrahedra},
                              MechanicalObject<Vec3d>{mesh.positions},
                              DiagonalMass<Vec3d>{.massDensity = 1000},
                              TetrahedronFEMForceField<Vec3d>{.youngModulus = young, .poissonRatio = 0.4},
                              FixedConstraint<Vec3d>{.indices = fixed})};
  sim.init();
  return sim;
}

/// All velocities after `steps` steps, as one vector.
template <class Sim>
Eigen::VectorXd velocities(Sim& sim, int steps = 3, double dt = 0.02) {
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  return vec::flat(sim.root().state().velocity).template cast<double>();
}

}  // namespace fem_bar
