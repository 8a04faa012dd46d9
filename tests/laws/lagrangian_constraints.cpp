// SPDX-License-Identifier: BSL-1.0
#include "lagrangian_laws.hpp"

using namespace sinew;

TEST_CASE("rows of Lagrangian constraints are the derivative of their violation") {
  laws::check_lagrangian_constraints<LagrangianConstraints, Vec1d>();
  laws::check_lagrangian_constraints<LagrangianConstraints, Vec2d>();
  laws::check_lagrangian_constraints<LagrangianConstraints, Vec3d>();
  laws::check_lagrangian_constraints<LagrangianConstraints, Vec6d>();
  laws::check_lagrangian_constraints<LagrangianConstraints, Rigid3d>();
}

TEST_CASE("rows over the rarer DataTypes are the derivative of their violation") {
  using Rarer = Registry<UniformLagrangianConstraint<Vec2d>,
                         UniformLagrangianConstraint<Vec6d>,
                         BilateralLagrangianConstraint<Vec1d>,
                         BilateralLagrangianConstraint<Vec2d, Linked>,
                         BilateralLagrangianConstraint<Rigid2d, Linked>,
                         FixedLagrangianConstraint<Rigid2d>,
                         SlidingLagrangianConstraint<Vec2d>,
                         SlidingLagrangianConstraint<Rigid2d, Linked>>;
  laws::check_lagrangian_constraints<Rarer, Vec1d>();
  laws::check_lagrangian_constraints<Rarer, Vec2d>();
  laws::check_lagrangian_constraints<Rarer, Vec6d>();
  laws::check_lagrangian_constraints<Rarer, Rigid2d>();
}
