// SPDX-License-Identifier: BSL-1.0
// After a reset a scene goes through the same bits again, whatever its solvers and materials remember.
#include "reset.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/tetrahedron_viscoelasticity.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/solver/bdf2.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/newmark_implicit.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/solver/runge_kutta45.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

namespace test_reset {

using namespace sinew;

namespace {

/// A string that hangs and swings, under some solvers.
template <class... Solvers>
auto swinging(Solvers... solvers) {
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      solvers...,
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1.5, 0.1, 0}}},
      UniformMass<Vec3d>{.vertexMass = 0.1},
      StiffSpringForceField<Vec3d>{{{0, 1, 50, 0.1, 0.5}, {1, 2, 80, 0.1, 0.5}, {2, 3, 300, 0, 0.5}}},
      FixedConstraint<Vec3d>{.indices = {0}})};
}

}  // namespace

TEST_CASE("what solvers remember of steps goes with a reset") {
  using Blocks = CompressedRowSparseMatrixMat3x3d;
  const CGLinearSolver<> cg{.iterations = 50, .tolerance = 1e-12};
  comes_back(swinging(EulerImplicitSolver{}, cg));
  comes_back(swinging(BDFOdeSolver{.order = 2}, cg));
  comes_back(swinging(BDFOdeSolver{.order = 3}, SparseLDLSolver<>{}));
  comes_back(swinging(NewmarkImplicitSolver{}, cg));
  comes_back(swinging(RungeKutta45Solver{.tolerance = 1e-9}));
  comes_back(swinging(EulerImplicitSolver{}, ShewchukPCGLinearSolver<>{.tolerance = 1e-3, .updateStep = 7}));
  comes_back(swinging(EulerImplicitSolver{},
                      ShewchukPCGLinearSolver<Blocks>{.tolerance = 1e-3, .updateStep = 0, .warp = true}));
}

TEST_CASE("a material forgets its past in a reset") {
  const TetrahedronViscoelasticityFEMForceField<Vec3d> viscoelastic{
      .materialName = ViscoelasticMaterial::Prony, .parameterSet = {200, 800, 0.03, 300, 0.5, 400}};
  const TetrahedronFEMForceField<Vec3d> plastic{
      .youngModulus = {2000}, .plasticMaxThreshold = 0.05, .plasticYieldThreshold = 0.01};
  auto block = [](auto const& material, auto... solvers) {
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        solvers...,
        MeshTopology{.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}}},
        MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1.1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.2}},
                                .restPosition = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}},
        UniformMass<Vec3d>{.vertexMass = 0.2},
        material,
        FixedConstraint<Vec3d>{.indices = {0, 2, 3}})};
  };
  const CGLinearSolver<> cg{.iterations = 50, .tolerance = 1e-12};
  comes_back(block(viscoelastic, EulerImplicitSolver{}, cg));
  comes_back(block(plastic, EulerImplicitSolver{}, cg));
  comes_back(block(viscoelastic, BDFOdeSolver{.order = 2}, cg));
  comes_back(
      block(viscoelastic, EulerImplicitSolver{.trapezoidalScheme = true, .maxNbIterationsNewton = 3}, cg));
}

}  // namespace test_reset
