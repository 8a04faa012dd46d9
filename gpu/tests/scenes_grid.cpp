// SPDX-License-Identifier: BSL-1.0
#include "scenes_grid.hpp"

#include "same_as_host.hpp"

namespace test_scenes_grid {

using namespace gpu_test;

TEST_CASE("hexahedra bend on the device as on the host") { same_as_host<HexahedraBar, Vec3d>(1e-10); }
TEST_CASE("a grid of springs falls on a plane on the device as on the host") {
  same_as_host<GridOnPlane, Vec3d>(1e-10);
}

}  // namespace test_scenes_grid
