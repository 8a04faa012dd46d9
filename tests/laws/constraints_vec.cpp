// SPDX-License-Identifier: BSL-1.0
#include "constraint_laws.hpp"

using namespace sinew;

TEST_CASE("constraints over Vec1d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Vec1d>, Vec1d>();
}

TEST_CASE("constraints over Vec2d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Vec2d>, Vec2d>();
}

TEST_CASE("constraints over Vec6d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Vec6d>, Vec6d>();
}
