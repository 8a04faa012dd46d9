// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while a wire is pushed out of its sheath and drawn back.
#include "static/allocations.hpp"

#include "catch.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/control/interventional_radiology_controller.hpp>
#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/mapping/adaptive_beam_mapping.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

TEST_CASE("a step of a wire allocates nothing") {
  const auto beams = rod_beams("wire",
                               {{.length = 0.2,
                                 .youngModulus = 1e9,
                                 .poissonRatio = 0.3,
                                 .massDensity = 6000,
                                 .radius = 5e-4,
                                 .nbBeams = 10,
                                 .spireDiameter = 0.1}});
  Simulation sim{node<"root">(
      Gravity{{0, 0, -10}},
      EulerImplicitSolver{.rayleighStiffness = 0.02},
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      MechanicalObject<Rigid3d>{.position = Rigid3d::VecCoord(11, Rigid3d::zero())},
      AdaptiveBeamForceField<Rigid3d>{.interpolation = beams},
      AdaptiveBeamMass<Rigid3d>{.interpolation = beams},
      InterventionalRadiologyController<Rigid3d>{.instruments = beams, .speed = 0.5},
      node<"points">(MechanicalObject<Vec3d>{},
                     AdaptiveBeamMapping<Rigid3d, Vec3d>{.interpolation = beams, .nbPointsPerBeam = 2}))};
  sim.init();
  for (int i = 0; i < 2; ++i) sim.animate(0.005);
  const long before = allocations;
  for (int i = 0; i < 30; ++i) sim.animate(0.005);
  sim.root().get<InterventionalRadiologyController<Rigid3d>>().speed = -0.5;
  for (int i = 0; i < 30; ++i) sim.animate(0.005);
  CHECK(allocations == before);
}
