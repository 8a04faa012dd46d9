// SPDX-License-Identifier: BSL-1.0
// Triangles and their bending on the device against the processor.
#include "agrees.hpp"
#include "samples_elements.hpp"

namespace test_drivers_surfaces {

using namespace gpu_test;

TEST_CASE("membrane triangles on the device equal those of the processor") {
  agrees<Triangles, Vec3d>();
  agrees<Triangles, Vec3f>();
}
TEST_CASE("bending springs of triangles on the device equal those of the processor") {
  agrees<Bending, Vec3d>();
  agrees<Bending, Vec3f>();
}
TEST_CASE("triangles on the device move freely as a whole") {
  moves_freely<Triangles, Vec3d>(int(TriangleMethod::large));
  moves_freely<Triangles, Vec3d>(int(TriangleMethod::polar));
}

}  // namespace test_drivers_surfaces
