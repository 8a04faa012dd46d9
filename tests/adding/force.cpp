// SPDX-License-Identifier: BSL-1.0
// The words of the additions of CONTRIBUTING.md are in the registry, and the law suites prove what they stand
// for.
#include "laws/force_laws.hpp"

namespace test_force {

using namespace sinew;

static_assert(registered_index<Standard, GreenSpringForceField<Vec3d>> >= 0);
static_assert(registered_index<Standard, ScaleMapping<Vec3d, Vec3d>> >= 0);
static_assert(registered_index<Standard, VelocityVerletSolver> >= 0);
static_assert(registered_index<Standard, ProbeCollisionModel<Vec3d>> >= 0);

TEST_CASE("the law suite proves the force that CONTRIBUTING.md adds") {
  laws::check_force_fields<Registry<GreenSpringForceField<Vec3d>>, Vec3d>();
}
TEST_CASE("the contact manager of scene files has the response that CONTRIBUTING.md adds") {
  CHECK(DefaultContactManager::All::find("ElasticContact") >= 0);
}

}  // namespace test_force
