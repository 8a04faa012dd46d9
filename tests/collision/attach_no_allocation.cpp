// SPDX-License-Identifier: BSL-1.0
// Counts what the steps of a scene allocate in which something is pulled: all memory comes from operator new.
#include <sinew/collision/carving_manager.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include "collision/allocations.hpp"
#include "contact_scene.hpp"

namespace test_attach_no_allocation {

using namespace sinew;

TEST_CASE("neither a step in which something is pulled nor attaching, pulling and releasing allocate") {
  auto sim = contact_scene(
      MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1},
      10,
      floor_node(1000, 0.1),
      // what is touched, but not by the tool, stays
      CarvingManager{.active = true, .toolModel = "tool"},
      node<"tool">(MechanicalObject<Vec3d>{.position = {{0, 0, 9}}},
                   SphereCollisionModel<Vec3d>{.simulated = false}),
      node<"body">(EulerImplicitSolver{},
                   CGLinearSolver<>{},
                   TetrahedronTopology{{{0, 1, 2, 3}}},
                   MechanicalObject<Vec3d>{.position = {{0, 0, 0.3}, {1, 0, 0.3}, {0, 1, 0.3}, {0, 0, 1.3}}},
                   UniformMass<Vec3d>{.vertexMass = 2},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                   TriangleCollisionModel<Vec3d>{.contactStiffness = 100}));
  sim.init();
  const auto hit = *sim.pick({3, 3, 3}, {-1, -1, -1}, 10);
  for (int i = 0; i < 200; ++i) sim.animate(0.01);
  const long before = allocations;
  int touched = 0;
  for (int round = 0; round < 20; ++round) {
    const int spring = sim.attach(hit, {.stiffness = 500, .damping = 5});
    for (int i = 0; i < 10; ++i) {
      sim.pull(spring, hit.point + 0.01 * i * Eigen::Vector3d(1, 1, 1));
      sim.animate(0.01);
      touched += int(sim.root().get<Contacts>().contacts.size());
    }
    sim.release(spring);
    for (int i = 0; i < 50; ++i) sim.animate(0.01);
  }
  CHECK(allocations == before);
  CHECK(touched > 0);
}

}  // namespace test_attach_no_allocation
