// SPDX-License-Identifier: BSL-1.0
// Steps of a runtime tree that has no profile: off SCENE STEPS. The scenes have 512 points: `matrix_free` and
// `assembled`, a body of 2,058 tetrahedra, and `nodes`, 128 nodes with a tetrahedron each, where finding
// components is most of the work.
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <cstdio>
#include <cstdlib>
#include <string_view>

using namespace sinew;

namespace {

using Blocks = CompressedRowSparseMatrixMat3x3d;
struct Few : Registry<Gravity, TetrahedronTopology, MechanicalObject<Vec3d>, UniformMass<Vec3d>,
                      TetrahedronFEMForceField<Vec3d>, FixedConstraint<Vec3d>, EulerImplicitSolver,
                      CGLinearSolver<>, CGLinearSolver<Blocks>> {};

void fill(RuntimeNode<Few>& node, Mesh const& mesh) {
  node.add(TetrahedronTopology{mesh.tetrahedra}, "topology");
  node.add(MechanicalObject<Vec3d>{.position = mesh.positions}, "points");
  node.add(UniformMass<Vec3d>{.totalMass = 1}, "mass");
  node.add(TetrahedronFEMForceField<Vec3d>{.youngModulus = {1000}, .poissonRatio = 0.3}, "forces");
  node.add(FixedConstraint<Vec3d>{.indices = {0, 1}}, "fixed");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: off matrix_free|assembled|nodes STEPS\n");
    return 2;
  }
  const std::string_view scene = argv[1];
  RuntimeNode<Few> root("root");
  root.add(Gravity{{0, -9.81, 0}}, "gravity");
  root.add(EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1}, "ode");
  if (scene == "assembled")
    root.add(CGLinearSolver<Blocks>{.iterations = 25, .tolerance = 0}, "linear");
  else
    root.add(CGLinearSolver<>{.iterations = 25, .tolerance = 0}, "linear");
  if (scene == "nodes")
    for (int i = 0; i < 128; ++i)
      fill(root.addChild("body" + std::to_string(i)),
           {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .tetrahedra = {{0, 1, 2, 3}}});
  else
    fill(root.addChild("body"), regular_grid_tetrahedra(8, 8, 8, {0, 0, 0}, {1, 1, 1}));
  Simulation simulation{std::move(root)};
  simulation.init();
  for (int i = 0; i < std::atoi(argv[2]); ++i) simulation.animate(0.01);
  std::printf("%.17g\n", simulation.kineticEnergy());
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "off: %s\n", error.what());
  return 1;
}
