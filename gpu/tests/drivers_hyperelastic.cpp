// SPDX-License-Identifier: BSL-1.0
// Hyperelastic tetrahedra on the device against the processor.
#include "agrees.hpp"
#include "samples_hyperelastic.hpp"

namespace test_drivers_hyperelastic {

using namespace gpu_test;

TEST_CASE("hyperelastic tetrahedra on the device equal those of the processor") {
  agrees<Hyperelasticity, Vec3d>();
}
TEST_CASE("hyperelastic tetrahedra in float on the device equal those of the processor") {
  agrees<Hyperelasticity, Vec3f>();
}
TEST_CASE("hyperelastic tetrahedra on the device move freely and pass the patch test") {
  for (int v = 0; v < Hyperelasticity::variants; ++v) {
    moves_freely<Hyperelasticity, Vec3d>(v);
    passes_patch_test<Hyperelasticity, Vec3d>(v);
  }
}

}  // namespace test_drivers_hyperelastic
