// SPDX-License-Identifier: BSL-1.0
// A rubber gate that a dam break bends, with the sizes of Antoci, Gallati, Sibilla (2007).
#include "catch.hpp"
#include "fluid_tank.hpp"

#include <sinew/force/fluid_boundary.hpp>
#include <sinew/mechanics.hpp>

#include <vector>

namespace test_elastic_gate {

using namespace sinew;
using tank::Points;

namespace {

// Water of 100 x 140 mm behind a plate of rubber that is clamped on top, 79 mm long and 5 mm thick, with
// E = 12 MPa and nu = 0.4. The gate is lighter than the water that it moves: the fluid has to give way a
// little, by the speed of sound, as that of SPHFluidForceField does.
constexpr double width = 0.1, height = 0.14, length = 0.079, thickness = 0.005;
constexpr double poisson = 0.4, gateDensity = 1100, density = 1000, g = 9.81;

/// How far the free end goes with the water, when, and how much it is lifted there [m, s]; where it is at the
/// end.
struct Path {
  double farthest = 0, at = 0, lift = 0, end = 0;
};
/// A slab of three particles behind a gate whose edges are free, so that it bends as a beam.
Path bend(double young, double time) {
  const double d = 0.005;
  const int across = 3, wide = 20, high = 28, rows = 16, past = 10;
  const double radius = 2 * d, mass = density * d * d * d, row = length / rows, slab = across * d;
  // walls: a floor that ends behind the gate, the back, two sides, and the wall above the gate
  Points walls;
  for (auto const& p : tank::block(d, wide + past + 2, high + 6, across + 2, {-d, -d, -d})) {
    const bool aside = p[2] < 0 || p[2] > slab,
               above = p[0] > width && p[0] < width + d && p[1] > length + row / 2;
    if (p[0] > width && p[1] > length / 1.3 && !above) continue;
    if (p[0] < 0 || p[1] < 0 || aside || above) walls.push_back(p);
  }
  // two beams for each row of boundary particles, which is fixed to the frame between them; the wet face is
  // half a distance in front of these
  Rigid3d::VecCoord frames;
  std::vector<Edge> beams;
  Points face;
  std::vector<int> carriers;
  for (int k = 0; k <= 2 * rows; ++k) {
    Rigid3d::Coord frame = Rigid3d::zero();
    frame.center = {width + thickness / 2, length - k * row / 2, slab / 2};
    frames.push_back(frame);
    if (k > 0) beams.push_back({k - 1, k});
    if (k % 2 == 0) continue;
    for (int j = 0; j < across; ++j) {
      face.push_back({(d - thickness) / 2, 0, (j + 0.5) * d - slab / 2});
      carriers.push_back(k);
    }
  }
  const double sound = 10 * std::sqrt(2 * g * height), dt = 0.2 * radius / sound;
  const double ofFrame = gateDensity * thickness * slab * row / 2;
  Simulation sim{node<"root">(
      Gravity{{0, -g, 0}},
      node<"water">(EulerExplicitSolver{},
                    MechanicalObject<Vec3d>{.position = tank::block(d, wide, high, across)},
                    UniformMass<Vec3d>{.vertexMass = mass},
                    SPHFluidForceField<Vec3d>{.radius = radius,
                                              .mass = mass,
                                              .pressure = sound * sound,
                                              .density = density,
                                              .viscosity = density * 0.02 * sound * radius / 16,
                                              .kernelType = 1,
                                              .viscosityType = 2}),
      node<"walls">(MechanicalObject<Vec3d>{.position = walls}, FluidBoundary<Vec3d>{}),
      node<"gate">(
          EulerImplicitSolver{},
          SparseLDLSolver<CompressedRowSparseMatrixd>{},
          MeshTopology{.edges = beams},
          MechanicalObject<Rigid3d>{.position = frames},
          UniformMass<Rigid3d>{.vertexMass =
                                   Rigid3d::MassType{.mass = ofFrame,
                                                     .inertia = Eigen::Matrix3d::Identity() * ofFrame *
                                                                (thickness * thickness + slab * slab) / 12}},
          BeamFEMForceField<Rigid3d>{.poissonRatio = poisson,
                                     .youngModulus = young,
                                     .crossSectionShape = CrossSectionShape::rectangular,
                                     .lengthY = thickness,
                                     .lengthZ = slab,
                                     .shearStressComputation = true},
          FixedConstraint<Rigid3d>{.indices = {0}},
          node<"face">(MechanicalObject<Vec3d>{.position = face},
                       RigidMapping<Rigid3d, Vec3d>{.rigidIndices = carriers},
                       FluidBoundary<Vec3d>{})))};
  sim.init();
  auto& gate = sim.at<"gate">().state();
  // the gate is held until the water is at rest
  auto& water = sim.at<"water">().state();
  while (sim.time() < 0.04) {
    sim.animate(dt);
    gate.position = frames;
    gate.velocity.assign(frames.size(), Rigid3d::Deriv::Zero());
    for (auto& v : water.velocity) v *= 0.98;
  }
  const double opened = sim.time();
  Path path;
  while (sim.time() < opened + time) {
    sim.animate(dt);
    const Eigen::Vector3d moved = gate.position.back().center - frames.back().center;
    if (moved[0] > path.farthest) path = {moved[0], sim.time() - opened, moved[1], 0};
    path.end = moved[0];
  }
  return path;
}

}  // namespace

TEST_CASE("a rubber gate opens before broken water, farther where it is softer, and comes back", "[long]") {
  // Those who cite the experiment have its end go 45 mm with the water at about 0.14 s, and give the rubber 7
  // to 12 MPa: scale and time are checked by that, not the path. With 5 mm between particles the level of the
  // water, which bends the gate by its height to the third power, is known to 2.5 mm of 79, which is 10 %,
  // and the gap below the gate loses half of one on each side.
  const Path firm = bend(12e6, 0.3), soft = bend(8e6, 0.17);
  CAPTURE(firm.farthest, firm.at, firm.lift, firm.end, soft.farthest, soft.at, soft.lift);
  CHECK(firm.farthest == Approx(0.045).epsilon(0.2));
  CHECK(firm.at == Approx(0.14).margin(0.04));
  CHECK(firm.end < 0.9 * firm.farthest);
  CHECK(firm.end > 0.5 * firm.farthest);
  CHECK(soft.farthest == Approx(0.045).epsilon(0.2));
  CHECK(soft.at == Approx(0.14).margin(0.04));
  CHECK(soft.farthest > 1.05 * firm.farthest);
  // a slender beam keeps its length: the end of a small deflection w is lifted by 3/5 w^2 / L under a load at
  // the end, and by 4/7 w^2 / L under an even one
  for (Path const& path : {firm, soft})
    CHECK(path.lift == Approx(0.6 * path.farthest * path.farthest / length).epsilon(0.15));
}

}  // namespace test_elastic_gate
