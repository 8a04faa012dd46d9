// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mechanics.hpp>

namespace examples {

/// A mass-spring string that hangs from a fixed point and carries a rigid body: a point of the body, given by
/// a rigid mapping, is tied to the end of the string by an interaction spring. `solvers`: any ODE solver, and
/// the linear solver that it needs.
template <class... Solvers>
auto string_on_rigid(Solvers... solvers) {
  using namespace sinew;
  constexpr int masses = 10;
  constexpr double link = 0.1;  // m
  Vec3d::VecCoord points;
  std::vector<Spring> links;
  for (int i = 0; i < masses; ++i) {
    points.push_back({link * i, 0, 0});
    if (i > 0)
      links.push_back({.first = i - 1, .second = i, .stiffness = 500, .damping = 0.2, .length = link});
  }
  // a brick of 0.2 x 0.1 x 0.1 m and 1 kg; I = m/12 (b^2 + c^2)
  const RigidMass<double, 3> brick{
      1, Eigen::Vector3d(0.02 / 12, 0.05 / 12, 0.05 / 12).asDiagonal().toDenseMatrix()};
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      solvers...,
      StiffSpringForceField<Vec3d, Between<"string", "brick/corner">>{
          .springs = {{.first = masses - 1, .second = 0, .stiffness = 500, .damping = 0.2, .length = link}}},
      node<"string">(MechanicalObject<Vec3d>{points},
                     UniformMass<Vec3d>{.vertexMass = 0.05},
                     StiffSpringForceField<Vec3d>{links},
                     FixedConstraint<Vec3d>{.indices = {0}}),
      node<"brick">(MechanicalObject<Rigid3d>{.position = {{.center = {link * masses + 0.1, -0.05, 0}}}},
                    UniformMass<Rigid3d>{.vertexMass = brick},
                    node<"corner">(MechanicalObject<Vec3d>{.position = {{-0.1, 0.05, 0}}},
                                   RigidMapping<Rigid3d, Vec3d>{})))};
}

}  // namespace examples
