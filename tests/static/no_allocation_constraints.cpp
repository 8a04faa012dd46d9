// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while scenes with constraints by multipliers step, after those that find how much
// room they need.
#include "static/allocations.hpp"

#include "catch.hpp"

#include <sinew/contact.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>

using namespace sinew;

namespace {

template <class Sim>
long allocations_of(Sim sim, int first = 2) {
  sim.init();
  for (int i = 0; i < first; ++i) sim.animate(0.005);
  REQUIRE(sim.root().template get<FreeMotionAnimationLoop>().motion.rows.count() > 0);
  const long before = allocations;
  for (int i = 0; i < 60; ++i) sim.animate(0.005);
  return allocations - before;
}

// a block that is held and joined to a rigid body
template <class Solver, class Ode, class... Components>
auto joined(Solver solver, Ode ode, Components... components) {
  const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {0.3, 0.2, 0.2});
  return Simulation{
      node<"root">(FreeMotionAnimationLoop{},
                   solver,
                   Gravity{{0, 0, -10}},
                   BilateralLagrangianConstraint<Vec3d, Between<"block", "rigid/points">>{
                       .first_point = {0, 3}, .second_point = {0, 1}},
                   node<"block">(ode,
                                 TetrahedronTopology{mesh.tetrahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 DiagonalMass<Vec3d>{.massDensity = 1000},
                                 TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e4}, .poissonRatio = 0.3},
                                 FixedConstraint<Vec3d>{.indices = {35}},
                                 FixedLagrangianConstraint<Vec3d>{.indices = {34, 33}},
                                 components...),
                   node<"rigid">(EulerExplicitSolver{},
                                 MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}},
                                 UniformMass<Rigid3d>{},
                                 node<"points">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0.3, 0, 0}}},
                                                RigidMapping<Rigid3d, Vec3d>{})))};
}

}  // namespace

TEST_CASE("a step with constraints by multipliers allocates nothing") {
  const BlockGaussSeidelConstraintSolver sweeps{};
  const EulerImplicitSolver implicit{};
  CHECK(allocations_of(joined(sweeps, implicit, SparseLDLSolver<>{})) == 0);
  auto turning = joined(sweeps, implicit, SparseLDLSolver<>{});
  turning.root().get<FreeMotionAnimationLoop>().newtonIterations = 20;
  CHECK(allocations_of(turning) == 0);
  CHECK(allocations_of(joined(sweeps, implicit, CGLinearSolver<>{})) == 0);
  CHECK(allocations_of(joined(sweeps, implicit, CholeskySolver<>{})) == 0);
  CHECK(allocations_of(joined(sweeps, implicit, MinResLinearSolver<>{})) == 0);
  CHECK(allocations_of(joined(sweeps, implicit, ShewchukPCGLinearSolver<>{})) == 0);
  CHECK(allocations_of(joined(sweeps, EulerExplicitSolver{})) == 0);
  CHECK(allocations_of(joined(NNCGConstraintSolver{}, implicit, SparseLDLSolver<>{})) == 0);
  CHECK(allocations_of(joined(sweeps,
                              implicit,
                              SparseLDLSolver<>{},
                              UncoupledConstraintCorrection<Vec3d>{.defaultCompliance = 1})) == 0);
  CHECK(allocations_of(joined(sweeps,
                              implicit,
                              SparseLDLSolver<>{},
                              PrecomputedConstraintCorrection<Vec3d>{.rotations = true})) == 0);
}

TEST_CASE("contacts by multipliers that come and go allocate nothing once they have been as many") {
  // a block that bounces and slides on a floor: in the first steps all of its lower side has touched
  const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0.02}, {0.3, 0.2, 0.22});
  Simulation sim{node<"root">(
      FreeMotionAnimationLoop{},
      BlockGaussSeidelConstraintSolver{},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.03, .contactDistance = 0.01},
      DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = "mu=0.3"},
      Gravity{{1, 0, -10}},
      node<"block">(EulerImplicitSolver{},
                    SparseLDLSolver<>{},
                    TetrahedronTopology{mesh.tetrahedra},
                    MechanicalObject<Vec3d>{mesh.positions},
                    DiagonalMass<Vec3d>{.massDensity = 1000},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                    PointCollisionModel<Vec3d>{}),
      node<"floor">(MeshTopology{.triangles = {{0, 1, 2}, {0, 2, 3}}},
                    MechanicalObject<Vec3d>{.position = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}},
                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}))};
  CHECK(allocations_of(std::move(sim), 100) == 0);
}
