// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/contact.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include "catch.hpp"
#include "registry_scene.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

inline constexpr double g = 10;  // [m/s^2]

/// A root with all stages, and contacts by multipliers with friction mu. Bodies touch at the contact distance
/// 0.01 m.
template <class Solver, class Intersection, class... Children>
auto constrained_scene_by(Solver solver, Intersection intersection, double mu, Children... children) {
  return RegistryScene{node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      intersection,
      DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = text("mu=", mu)},
      Gravity{{0, 0, -g}},
      children...)};
}
template <class Intersection, class... Children>
auto constrained_scene(Intersection intersection, double mu, Children... children) {
  return constrained_scene_by(BlockGaussSeidelConstraintSolver{.maxIterations = 20000, .tolerance = 1e-13},
                              intersection,
                              mu,
                              children...);
}
inline MinProximityIntersection near_by() { return {.alarmDistance = 0.1, .contactDistance = 0.01}; }

/// Two triangles, 40 m wide, through the origin, turned by an angle about y: x goes up the slope.
inline auto fixed_floor(double angle = 0) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Eigen::Vector3d> p{{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
  for (auto& x : p) x = Eigen::Vector3d(c * x[0], x[1], s * x[0]);
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  return node<"floor">(topology,
                       MechanicalObject<Vec3d>{.position = p},
                       TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false});
}

/// The surface of a block by its eight corners: the first four go round the lower face, seen from below.
inline const std::vector<Triangle> blockSurface{{0, 2, 1},
                                                {0, 3, 2},
                                                {4, 5, 6},
                                                {4, 6, 7},
                                                {0, 1, 5},
                                                {0, 5, 4},
                                                {1, 2, 6},
                                                {1, 6, 5},
                                                {2, 3, 7},
                                                {2, 7, 6},
                                                {3, 0, 4},
                                                {3, 4, 7}};

/// A soft block of 2 kg, whose points collide, in static equilibrium with what holds it.
template <class Held>
auto static_block(Mesh const& mesh, Held held) {
  return node<"block">(StaticSolver{},
                       SparseLDLSolver<>{},
                       TetrahedronTopology{mesh.tetrahedra},
                       MechanicalObject<Vec3d>{mesh.positions},
                       UniformMass<Vec3d>{.totalMass = 2},
                       TetrahedronFEMForceField<Vec3d>{
                           .youngModulus = {1e5}, .poissonRatio = 0.3, .method = RotationMethod::small},
                       held,
                       PointCollisionModel<Vec3d>{});
}

/// A rigid of 2 kg in the frame of the slope, with spheres that touch there.
inline Rigid3d::Coord on_slope(double angle, Eigen::Vector3d const& place) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()));
  return {turn * place, turn};
}

/// The sum of the forces of all contacts on what is their second side, minus that on the first where that is
/// `body`.
template <class Manager>
Eigen::Vector3d force_on(Manager const& manager, std::string const& body) {
  Eigen::Vector3d sum(0, 0, 0);
  for (Contact const& c : manager.contacts) {
    if (manager.surfaces[std::size_t(c.b.surface)]->path == body) sum += c.force;
    if (manager.surfaces[std::size_t(c.a.surface)]->path == body) sum -= c.force;
  }
  return sum;
}

}  // namespace sinew
