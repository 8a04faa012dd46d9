// SPDX-License-Identifier: BSL-1.0
#include <catch2/catch.hpp>
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
#include <sinew/force/gravity.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

using namespace sinew;

namespace {

using Manager = ContactManager<PenalityContactForceField, StickContactForceField>;

// a floor of two triangles at z = 0, in its plane 20 m wide
auto floor_node(double friction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Eigen::Vector3d> p{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  for (auto& x : p) x = Eigen::Vector3d(c * x[0], x[1], s * x[0]);
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  return node<"floor">(topology, MechanicalObject<Vec3d>{.position = p},
                       TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactStiffness = 1000, .contactFriction = friction});
}

}  // namespace

TEST_CASE("a ball under gravity rests on a floor, as deep in it as its weight presses") {
  Simulation sim{node<"root">(DefaultPipeline{}, BruteForceBroadPhase{}, BVHNarrowPhase{},
                              MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1}, Manager{}, Gravity{{0, 0, -10}},
                              floor_node(0, 0),
                              node<"ball">(EulerImplicitSolver{}, CGLinearSolver<>{}, MechanicalObject<Vec3d>{.position = {{0, 0.3, 0.65}}},
                                           UniformMass<Vec3d>{.vertexMass = 2},
                                           SphereCollisionModel<Vec3d>{.contactStiffness = 100, .contactDamping = 50, .radius = 0.5}))};
  sim.init();
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  // k = 1000 * 100 / (0.1 + 0.5), weight 20 N: m g / k deep, below the contact distance 0.1
  const double k = 1000 * 100 / 0.6, height = 0.5 + 0.1 - 2 * 10 / k;
  CHECK(sim.at<"ball">().state().position[0][2] == Approx(height).margin(1e-9));
  CHECK(sim.at<"ball">().state().velocity[0].norm() < 1e-9);
}
