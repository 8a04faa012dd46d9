// SPDX-License-Identifier: BSL-1.0
#include "scenes_explicit.hpp"

#include "same_as_host.hpp"

namespace test_scenes_explicit {

using namespace gpu_test;

TEST_CASE("symplectic Euler on the device goes as on the host") {
  same_as_host<SwingingGrid<EulerExplicitSolver>, Vec3d>(1e-12);
  same_as_host<SwingingGrid<EulerExplicitSolver>, Vec3f>(1e-5);
}
TEST_CASE("the midpoint method on the device goes as on the host") {
  same_as_host<SwingingGrid<RungeKutta2Solver>, Vec3d>(1e-12);
}
TEST_CASE("a hyperelastic cube falls on a plane on the device as on the host") {
  same_as_host<HyperelasticCube, Vec3d>(1e-10);
}

}  // namespace test_scenes_explicit
