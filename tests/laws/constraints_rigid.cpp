// SPDX-License-Identifier: BSL-1.0
#include "constraint_laws.hpp"

using namespace sinew;

TEST_CASE("constraints over Rigid2d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Rigid2d>, Rigid2d>();
}

TEST_CASE("constraints over Rigid3d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Rigid3d>, Rigid3d>();
}

TEST_CASE("constraints of rigid bodies in space are projectors, and hold as they say") {
  laws::check_constraints<SpatialRigids<Rigid3d>, Rigid3d>();
  laws::check_constraints<SpatialRigids<Rigid3f>, Rigid3f>();
}
