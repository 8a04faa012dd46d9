// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while fluids and bodies step after init.
#include "static/allocations.hpp"

#include "catch.hpp"
#include "fluid_tank.hpp"

#include <sinew/constraint/particle_sink.hpp>
#include <sinew/constraint/particle_source.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/force/fluid_boundary.hpp>
#include <sinew/force/particles_repulsion.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/sph_fluid.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/dfsph.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
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

TEST_CASE("no step in which particles come and go allocates, up to the capacity of their source") {
  auto count = [](auto... solvers) {
    Simulation sim{node<"root">(
        Threads{.count = 2},
        Gravity{},
        node<"drops">(solvers...,
                      MechanicalObject<Vec3d>{},
                      UniformMass<Vec3d>{.vertexMass = 0.1},
                      SPHFluidForceField<Vec3d>{
                          .radius = 0.1, .mass = 0.1, .density = 1000, .kernelType = 1, .viscosityType = 2},
                      PlaneForceField<Vec3d>{.d = -0.3},
                      ParticleSource<Vec3d>{.center = tank::block(0.05, 10, 1, 10),
                                            .velocity = {0, -1, 0},
                                            .delay = 0.05,
                                            .capacity = 3000},
                      ParticleSink<Vec3d>{.d0 = -9, .d1 = -0.2}))};
    sim.init();
    const long before = allocations;
    for (int i = 0; i < 40; ++i) sim.animate(0.01);
    sim.reset();
    for (int i = 0; i < 40; ++i) sim.animate(0.01);
    const long during = allocations - before;
    CHECK(sim.template at<"drops">().state().size() > 300);
    CHECK(sim.template at<"drops">().template get<ParticleSink<Vec3d>>().removed > 100);
    return during;
  };
  CHECK(count(EulerExplicitSolver{}) == 0);
  CHECK(count(EulerImplicitSolver{}, CGLinearSolver<>{}) == 0);
  CHECK(count(DFSPHSolver{.radius = 0.1, .density = 1000}) == 0);
  const ParticlesRepulsionForceField<Vec3d> apart{.distance = 0.04, .stiffness = 10};
  CHECK(count(EulerImplicitSolver{}, CGLinearSolver<>{}, apart) == 0);
}
