// SPDX-License-Identifier: BSL-1.0
#include "constraint_laws.hpp"

using namespace sinew;

TEST_CASE("constraints over Vec3d are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Vec3d>, Vec3d>();
}

TEST_CASE("constraints over Vec3f are projectors, and move as they say") {
  laws::check_constraints<PointConstraints<Vec3f>, Vec3f>();
}

TEST_CASE("movements of patches are projectors, and move as they say") {
  laws::check_constraints<Registry<PatchTestMovementProjectiveConstraint<Vec3d>>, Vec3d>();
  laws::check_constraints<Registry<PatchTestMovementProjectiveConstraint<Vec3f>>, Vec3f>();
}
