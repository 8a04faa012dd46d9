// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>

namespace test_view {

// a triangle of 3 kg in the plane z = 0 that collides, which nothing moves
inline auto triangle() {
  using namespace sinew;
  return Simulation{node<"root">(
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
      DefaultContactManager{},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
      node<"body">(MeshTopology{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}},
                   MechanicalObject<Vec3d>{},
                   UniformMass<Vec3d>{.totalMass = 3},
                   TriangleCollisionModel<Vec3d>{}))};
}

}  // namespace test_view
