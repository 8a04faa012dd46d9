// SPDX-License-Identifier: BSL-1.0
#include "scenes_bar.hpp"

#include "same_as_host.hpp"

namespace test_scenes_bar {

using namespace gpu_test;

TEST_CASE("a bar of tetrahedra bends on the device as on the host") { same_as_host<Bar, Vec3d>(1e-10); }
TEST_CASE("a bar of tetrahedra bends on the device in float as on the host") {
  // 25 iterations a step, each with sums of 1e-7, in a bar of slenderness 3
  same_as_host<Bar, Vec3f>(1e-4);
}

}  // namespace test_scenes_bar
