// SPDX-License-Identifier: BSL-1.0
// Linear tetrahedra and hexahedra on the device against the processor.
#include "agrees.hpp"
#include "samples_elements.hpp"

namespace test_drivers_elements {

using namespace gpu_test;

TEST_CASE("corotational tetrahedra on the device equal those of the processor") {
  agrees<Tetrahedra, Vec3d>();
  agrees<Tetrahedra, Vec3f>();
}
TEST_CASE("corotational hexahedra on the device equal those of the processor") {
  agrees<Hexahedra, Vec3d>();
  agrees<Hexahedra, Vec3f>();
}

TEST_CASE("tetrahedra and hexahedra on the device move freely as a whole") {
  for (const auto method :
       {RotationMethod::large, RotationMethod::polar, RotationMethod::nearest, RotationMethod::gradient}) {
    moves_freely<Tetrahedra, Vec3d>(int(method));
    moves_freely<Tetrahedra, Vec3f>(int(method));
  }
  for (const auto method : {HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::nearest})
    moves_freely<Hexahedra, Vec3d>(int(method));
}
TEST_CASE("tetrahedra and hexahedra on the device pass the patch test") {
  // `large` turns each element by the frame of its own edges: its stress is constant where nothing turns
  for (const auto method : {RotationMethod::small, RotationMethod::nearest, RotationMethod::gradient}) {
    passes_patch_test<Tetrahedra, Vec3d>(int(method));
    passes_patch_test<Tetrahedra, Vec3f>(int(method));
  }
  for (const auto method : {HexahedronMethod::small, HexahedronMethod::nearest})
    passes_patch_test<Hexahedra, Vec3d>(int(method));
}

TEST_CASE("a copy of a force field on the device has the same tangent") {
  const auto motion = motion_of<Tetrahedra, Vec3d>();
  auto force = ready<Tetrahedra, CudaVec3d>(0, motion);
  const CudaVec3d::VecCoord x(motion.x);
  const CudaVec3d::VecDeriv dx(motion.dx), zero(x.size(), {0, 0, 0});
  CudaVec3d::VecDeriv f = zero, one = zero, other = zero;
  MechanicalParams p;
  p.k = 1;
  add_force(force, p, f, x, dx);
  for (int i = 0; i < 3; ++i) {
    one = other = zero;
    add_dforce(force, p, one, dx);
    auto const copy = force;
    add_dforce(copy, p, other, dx);
    CHECK(relative_difference(other.host(), one.host()) < rounding<double>);
  }
}

}  // namespace test_drivers_elements
