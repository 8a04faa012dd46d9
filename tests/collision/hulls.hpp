// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/convex_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/node.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace sinew {

struct HullRotation {
  double angle = 0;
  Eigen::Vector3d axis{0, 0, 1};
};
inline RigidCoord3<double> rigid_at(Eigen::Vector3d const& center, HullRotation rotation = {}) {
  RigidCoord3<double> x;
  x.center = center;
  x.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(rotation.angle, rotation.axis.normalized()));
  return x;
}
inline std::vector<Eigen::Vector3d> box_corners(Eigen::Vector3d const& half) {
  std::vector<Eigen::Vector3d> p;
  for (int k = 0; k < 8; ++k)
    p.push_back({k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]});
  return p;
}
/// Boxes of half such sides, filled evenly.
template <FixedString Name>
auto box_node(std::vector<RigidCoord3<double>> const& places, Eigen::Vector3d const& half, double mass,
              double stiffness, double damping = 20, double friction = 0) {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) inertia(i, i) = mass / 3 * (half.squaredNorm() - half[i] * half[i]);
  return node<Name>(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
                    MechanicalObject<Rigid3d>{.position = places},
                    UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{mass, inertia}},
                    ConvexCollisionModel<Rigid3d>{.selfCollision = true,
                                                  .contactStiffness = stiffness,
                                                  .contactFriction = friction,
                                                  .contactDamping = damping,
                                                  .points = box_corners(half)});
}

}  // namespace sinew
