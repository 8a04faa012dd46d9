// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/line_collision_model.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include "catch.hpp"

namespace sinew {

using Contacts = DefaultContactManager;

/// A root with all stages and gravity along -z, with those children.
template <class Intersection, class... Children>
auto contact_scene(Intersection intersection, double gravity, Children... children) {
  return Simulation{node<"root">(DefaultPipeline{},
                                 BruteForceBroadPhase{},
                                 BVHNarrowPhase{},
                                 intersection,
                                 Contacts{},
                                 Gravity{{0, 0, -gravity}},
                                 children...)};
}

/// Two triangles, 20 m wide, through the origin, turned by an angle about y.
inline auto floor_node(double stiffness, double friction, double angle = 0) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Eigen::Vector3d> p{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  for (auto& x : p) x = Eigen::Vector3d(c * x[0], x[1], s * x[0]);
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  return node<"floor">(
      topology,
      MechanicalObject<Vec3d>{.position = p},
      TriangleCollisionModel<Vec3d>{
          .moving = false, .simulated = false, .contactStiffness = stiffness, .contactFriction = friction});
}

}  // namespace sinew
