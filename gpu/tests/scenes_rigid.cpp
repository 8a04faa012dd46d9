// SPDX-License-Identifier: BSL-1.0
#include "scenes_rigid.hpp"

#include "same_as_host.hpp"

namespace test_scenes_rigid {

using namespace gpu_test;

TEST_CASE("rigid bodies tumble on the device as on the host") { same_as_host<Tumbling, Rigid3d>(1e-12); }
TEST_CASE("a chain of angular springs swings on the device as on the host") {
  same_as_host<AngularChain, Rigid3d>(1e-10);
}

}  // namespace test_scenes_rigid
