// SPDX-License-Identifier: BSL-1.0
// A block of 960 corotational tetrahedra that hangs from a side, as assembled system and matrix-free.
#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

namespace guard {

using namespace sinew;

namespace {

template <class Linear>
auto block() {
  const Mesh mesh = regular_grid_tetrahedra(9, 6, 5, {0, 0, 0}, {0.16, 0.1, 0.08});
  std::vector<Index> held;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].x() == 0) held.push_back(Index(i));
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                   Linear{.iterations = 25, .tolerance = 0},
                   node<"block">(TetrahedronTopology{mesh.tetrahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 DiagonalMass<Vec3d>{.massDensity = 1000},
                                 TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                                 FixedConstraint<Vec3d>{.indices = held}))};
}

}  // namespace

void fem_assembled(int steps) { run(block<CGLinearSolver<CompressedRowSparseMatrixMat3x3d>>(), steps, 0.02); }
void fem_matrix_free(int steps) { run(block<CGLinearSolver<>>(), steps, 0.02); }

}  // namespace guard
