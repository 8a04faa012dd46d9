// SPDX-License-Identifier: BSL-1.0
#include "constraint_laws.hpp"

using namespace sinew;

TEST_CASE("constraints over Rigid2d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Rigid2d>, Rigid2d>();
}

TEST_CASE("constraints over Rigid3d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Rigid3d>, Rigid3d>();
}
