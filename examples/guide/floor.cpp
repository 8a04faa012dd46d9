// SPDX-License-Identifier: BSL-1.0
// A beam of silicone falls on a floor: the force of the contact over time, and a picture from nearby.
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/picture.hpp>

#include <cstdio>

using namespace sinew;

int main() {
  // 0.6 m long, 0.05 m wide and high, hexahedra between 25 x 3 x 3 points, 0.02 m above the floor
  const double length = 0.6, side = 0.05, gap = 0.02, density = 1100;
  const Mesh beam = regular_grid(25, 3, 3, {0, gap, 0}, {length, gap + side, side});

  MeshTopology ground;  // corners go round the triangles as seen from above
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Eigen::Vector3d> corners{
      {-0.1, 0, 0.2}, {0.7, 0, 0.2}, {0.7, 0, -0.15}, {-0.1, 0, -0.15}};

  Simulation sim{node<"root">(
      Gravity{{0, -9.81, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.005},
      DefaultContactManager{},
      node<"beam">(EulerImplicitSolver{.rayleighStiffness = 0.01},
                   CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 200, .tolerance = 1e-8},
                   MeshTopology{.hexahedra = beam.hexahedra},
                   MechanicalObject<Vec3d>{beam.positions},
                   DiagonalMass<Vec3d>{.massDensity = density},
                   HexahedronFEMForceField<Vec3d>{.youngModulus = {100000}, .poissonRatio = 0.45},
                   TriangleCollisionModel<Vec3d>{},
                   PointCollisionModel<Vec3d>{}),
      node<"floor">(ground,
                    MechanicalObject<Vec3d>{corners},
                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}))};
  sim.init();
  sim.keepForces(true);
  for (int step = 1; step <= 20; ++step) {
    sim.animate(0.01);
    double up = 0;
    for (ForceOnBody const& f : sim.forces())
      if (f.kind == ForceKind::contact && f.body == "/root/beam") up += f.wrench.force.y();
    if (step % 2 == 0) std::printf("%.2f s: the floor pushes with %.2f N\n", sim.time(), up);
  }
  std::printf("the beam weighs %.2f N\n", density * length * side * side * 9.81);

  view::PictureSettings settings{.width = 960, .height = 540, .seen = {.grid = true}};
  settings.camera = view::Camera{};
  settings.camera->toEye = Eigen::Vector3d(0.5, 0.5, 1).normalized();
  settings.camera->fit(
      {length / 2, 0, 0}, length / 2, 960. / 540);  // centre and radius of what is to be seen
  view::Picture(sim, settings).write("floor.png");
}
