// SPDX-License-Identifier: BSL-1.0
// A soft beam, held at one end, sinks onto a floor: how far, what the floor and the wall carry, and a
// picture.
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/picture.hpp>

#include <cstdio>

using namespace sinew;

int main() {
  // 0.5 m long, 0.1 m wide and high, cut into tetrahedra between 16 x 4 x 4 points
  const Mesh beam = regular_grid_tetrahedra(16, 4, 4, {0, 0, 0}, {0.5, 0.1, 0.1});
  std::vector<int> held;  // the points in the wall
  for (std::size_t i = 0; i < beam.positions.size(); ++i)
    if (beam.positions[i].x() == 0) held.push_back(int(i));

  // two triangles, 0.1 m below the beam; corners go round them as seen from above
  MeshTopology ground;
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Eigen::Vector3d> corners{
      {0, -0.1, 0.3}, {0.7, -0.1, 0.3}, {0.7, -0.1, -0.2}, {0, -0.1, -0.2}};

  Simulation sim{node<"root">(
      Gravity{{0, -9.81, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.005},
      DefaultContactManager{},
      node<"beam">(EulerImplicitSolver{.rayleighStiffness = 0.05},
                   CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 300, .tolerance = 1e-10},
                   TetrahedronTopology{beam.tetrahedra},
                   MechanicalObject<Vec3d>{beam.positions},
                   DiagonalMass<Vec3d>{.massDensity = 1000},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {20000}, .poissonRatio = 0.3},
                   FixedConstraint<Vec3d>{.indices = held},
                   TriangleCollisionModel<Vec3d>{.contactStiffness = 1000},
                   PointCollisionModel<Vec3d>{.contactStiffness = 1000}),
      node<"floor">(ground,
                    MechanicalObject<Vec3d>{corners},
                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}))};
  sim.init();
  sim.keepForces(true);
  while (sim.time() < 3) sim.animate(0.01);

  auto const& state = sim.at<"beam">().state();
  const Wrench wall = reaction_force(state, held);
  double floor = 0;
  for (ForceOnBody const& f : sim.forces())
    if (f.kind == ForceKind::contact && f.body == "/root/beam") floor += f.wrench.force.y();
  std::printf("the end is at y = %.4f m\n", state.position[15].y());
  std::printf("the wall carries %.2f N, the floor %.2f N, together the weight, %.2f N\n",
              wall.force.y(),
              floor,
              1000 * 0.5 * 0.1 * 0.1 * 9.81);
  view::Picture(sim, {.width = 960, .height = 540}).write("beam.png");
}
