// SPDX-License-Identifier: BSL-1.0
#include "scenes_joined.hpp"

#include "same_as_host.hpp"

namespace test_scenes_joined {

using namespace gpu_test;

TEST_CASE("two bodies joined by springs move on the device as on the host") {
  same_as_host<TwoBlocks, Vec3d>(1e-10);
}
TEST_CASE("a force that is there for the host alone acts on a body on the device") {
  same_as_host<HostForce, Vec3d>(1e-10);
}
TEST_CASE("a system assembled on the host moves a body on the device") {
  same_as_host<Assembled, Vec3d>(1e-10);
}

}  // namespace test_scenes_joined
