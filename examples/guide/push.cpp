// SPDX-License-Identifier: BSL-1.0
// A rigid box that moves as given pushes into a soft block: the force between them, and a picture.
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/cube_topology.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/view/picture.hpp>

#include <cstdio>

using namespace sinew;

int main() {
  std::vector<int> held;  // the far side of the block: of 6 x 6 x 6 points, numbered along x first
  for (int i = 5; i < 6 * 6 * 6; i += 6) held.push_back(i);

  Simulation sim{node<"root">(
      Gravity{{0, 0, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.005},
      DefaultContactManager{},
      // one solver for both bodies; no matrix of 3 x 3 blocks, which has no room for rigid bodies
      EulerImplicitSolver{.rayleighStiffness = 0.01},
      CGLinearSolver<>{.iterations = 200, .tolerance = 1e-9},
      node<"block">(RegularGridTopology{.n = {6, 6, 6}, .min = {0, -0.1, -0.1}, .max = {0.2, 0.1, 0.1}},
                    MechanicalObject<Vec3d>{},
                    DiagonalMass<Vec3d>{.massDensity = 1000},
                    HexahedronFEMForceField<Vec3d>{.youngModulus = {20000}, .poissonRatio = 0.4},
                    FixedConstraint<Vec3d>{.indices = held},
                    TriangleCollisionModel<Vec3d>{.contactStiffness = 100},
                    PointCollisionModel<Vec3d>{.contactStiffness = 100}),
      // one frame: a centre and an orientation (w, x, y, z); it goes 0.09 m along x in a second, and stays
      // there
      node<"box">(MechanicalObject<Rigid3d>{.position = {{.center = {-0.1, 0, 0}}}},
                  UniformMass<Rigid3d>{.totalMass = 1},
                  LinearMovementConstraint<Rigid3d>{
                      .keyTimes = {0, 1, 2},
                      .movements = {{0, 0, 0, 0, 0, 0}, {0.09, 0, 0, 0, 0, 0}, {0.09, 0, 0, 0, 0, 0}}},
                  // what collides: points and triangles that the frame carries, around its centre
                  node<"surface">(CubeTopology{.nx = 4,
                                               .ny = 4,
                                               .nz = 4,
                                               .min = {-0.05, -0.05, -0.05},
                                               .max = {0.05, 0.05, 0.05}},
                                  MechanicalObject<Vec3d>{},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  TriangleCollisionModel<Vec3d>{.contactStiffness = 100},
                                  PointCollisionModel<Vec3d>{.contactStiffness = 100})))};
  sim.init();
  sim.keepForces(true);
  for (int step = 1; step <= 150; ++step) {
    sim.animate(0.01);
    double push = 0;
    for (ForceOnBody const& f : sim.forces())
      if (f.kind == ForceKind::contact && f.body == "/root/block") push += f.wrench.force.x();
    if (step % 25 == 0) std::printf("%.2f s: the box pushes with %.1f N\n", sim.time(), push);
  }
  view::Picture(sim, {.width = 960, .height = 540}).write("push.png");
}
