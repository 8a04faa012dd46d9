// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace gpu_test {

/// A bar of tetrahedra that bends under its weight.
struct Bar : OneBody {
  static constexpr double dt = 0.02;
  static constexpr int steps = 50;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
    std::vector<int> fixed;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (mesh.positions[i][0] < 0.01) fixed.push_back(int(i));
    return Simulation{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                     CGLinearSolver<>{.iterations = 25, .tolerance = 0},
                     node<"body">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                                  MechanicalObject<D>{},
                                  DiagonalMass<D>{.massDensity = 1000},
                                  TetrahedronFEMForceField<D>{.youngModulus = {1e5}, .poissonRatio = 0.4},
                                  FixedConstraint<D>{.indices = fixed}))};
  }
};

}  // namespace gpu_test
