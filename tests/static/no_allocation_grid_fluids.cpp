// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while a fluid on a grid steps after init.
#include "static/allocations.hpp"

#include "catch.hpp"
#include "immersed_shapes.hpp"

#include <sinew/fluid/fluid3d.hpp>
#include <sinew/mechanics.hpp>

namespace test_fluid_no_allocation {

using namespace sinew;

TEST_CASE("a step of a fluid on a grid does not allocate") {
  for (const int threads : {1, 2}) {
    Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                                Threads{.count = threads},
                                node<"water">(Fluid3D<Vec3d>{.nx = 22,
                                                             .ny = 18,
                                                             .nz = 18,
                                                             .cellwidth = 0.05,
                                                             .height = 9,
                                                             .dir = {1, 0.5, 0},
                                                             .viscosity = 1,
                                                             .source = {0, 0.2, 0},
                                                             .sourceRadius = 0.1}))};
    const long before = allocations;
    sim.init();
    const long after = allocations;
    CHECK(after > before);
    for (int k = 0; k < 40; ++k) sim.animate(0.01);
    CHECK(allocations == after);
    CHECK(sim.kineticEnergy() > 0);
    CHECK(sim.warnings().list().empty());
  }
}

TEST_CASE("a step of a fluid on a grid in which a body swims does not allocate") {
  const Mesh box = shapes::box({-0.15, -0.15, -0.15}, {0.15, 0.15, 0.15});
  Rigid3d::Coord start = Rigid3d::zero();
  start.center = {0, 0.1, 0};
  Simulation sim{node<"root">(
      Gravity{{0, -9.81, 0}},
      node<"water">(Fluid3D<Vec3d>{.nx = 18,
                                   .ny = 18,
                                   .nz = 18,
                                   .cellwidth = 0.05,
                                   .height = 9,
                                   .viscosity = 1,
                                   .walls = fluid::Walls::stick}),
      node<"box">(EulerExplicitSolver{},
                  MechanicalObject<Rigid3d>{.position = {start}},
                  UniformMass<Rigid3d>{.vertexMass = Rigid3d::MassType{.mass = 14}},
                  node<"surface">(MeshTopology{.quads = box.quads},
                                  MechanicalObject<Vec3d>{.position = box.positions},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  ImmersedSolid<Vec3d>{})))};
  sim.init();
  const long after = allocations;
  for (int k = 0; k < 20; ++k) sim.animate(0.01);
  CHECK(allocations == after);
  CHECK(sim.at<"box">().state().velocity[0].norm() > 0);
}

}  // namespace test_fluid_no_allocation
