// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while fluids and bodies step after init.
#include "static/allocations.hpp"

#include "catch.hpp"
#include "fluid_tank.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/force/fluid_boundary.hpp>
#include <sinew/force/sph_fluid.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/dfsph.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

TEST_CASE("no step of a fluid with bodies allocates") {
  const double d = 0.1;
  auto count = [&](auto solver, auto force) {
    Simulation sim{node<"root">(Threads{.count = 2},
                                Gravity{},
                                node<"water">(solver,
                                              MechanicalObject<Vec3d>{.position = tank::block(d, 13, 13, 13)},
                                              UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d},
                                              force),
                                node<"walls">(MechanicalObject<Vec3d>{.position = tank::walls(d, 13, 15, 13)},
                                              FluidBoundary<Vec3d>{}))};
    sim.init();
    const long before = allocations;
    for (int i = 0; i < 5; ++i) sim.animate(0.002);
    return allocations - before;
  };
  const SPHFluidForceField<Vec3d> force{
      .radius = 0.2, .mass = 1, .density = 1000, .kernelType = 1, .viscosityType = 2};
  CHECK(count(EulerExplicitSolver{}, force) == 0);
  auto viscosity = force;
  viscosity.pressureType = 0;
  CHECK(count(DFSPHSolver{.radius = 2 * d}, viscosity) == 0);
}
