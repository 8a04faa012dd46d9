// SPDX-License-Identifier: BSL-1.0
// Balls that fall on a floor of triangles and on each other, with friction.
#include "scenes.hpp"

#include <sinew/sinew.hpp>

namespace guard {

using namespace sinew;

void contacts(int steps) {
  MeshTopology floor;
  std::vector<Eigen::Vector3d> corners, balls;
  for (int i = 0; i < 49; ++i) corners.push_back({0.3 * (i % 7) - 0.3, 0.3 * (i / 7) - 0.3, 0});
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const Index at = Index(7 * i + j);
      floor.triangles.push_back({at, at + 1, at + 8});
      floor.triangles.push_back({at, at + 8, at + 7});
    }
  for (int i = 0; i < 48; ++i) balls.push_back({0.29 * (i % 4), 0.31 * (i / 4 % 4), 0.16 + 0.31 * (i / 16)});
  run(Simulation{node<"root">(
          Gravity{{0, 0, -9.81}},
          DefaultPipeline{},
          BruteForceBroadPhase{},
          BVHNarrowPhase{},
          MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.02},
          DefaultContactManager{},
          node<"floor">(
              floor,
              MechanicalObject<Vec3d>{.position = corners},
              TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactFriction = 0.2}),
          node<"balls">(EulerImplicitSolver{},
                        CGLinearSolver<>{.iterations = 25, .tolerance = 0},
                        MechanicalObject<Vec3d>{.position = balls},
                        UniformMass<Vec3d>{},
                        SphereCollisionModel<Vec3d>{.selfCollision = true, .radius = 0.15}))},
      steps,
      0.005);
}

}  // namespace guard
