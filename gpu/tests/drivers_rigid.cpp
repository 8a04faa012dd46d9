// SPDX-License-Identifier: BSL-1.0
// Forces between rigid bodies on the device against the processor.
#include "agrees.hpp"
#include "samples_rigid.hpp"

namespace test_drivers_rigid {

using namespace gpu_test;

TEST_CASE("angular springs on the device equal those of the processor") {
  agrees<AngularSprings, Rigid3d>();
  agrees<AngularSprings, Rigid3f>();
}

}  // namespace test_drivers_rigid
