// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/fast_triangular_bending_springs.hpp>
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/triangle_fem.hpp>

namespace gpu_test {

using namespace sinew;

/// The methods to find a rotation.
struct Tetrahedra {
  static constexpr int variants = 5;
  template <class D>
  static auto make(int v) {
    return TetrahedronFEMForceField<D>{
        .youngModulus = {1000}, .poissonRatio = 0.3, .method = RotationMethod(v)};
  }
};
struct Hexahedra {
  static constexpr int variants = 4;
  template <class D>
  static auto make(int v) {
    return HexahedronFEMForceField<D>{
        .youngModulus = {1000}, .poissonRatio = 0.3, .method = HexahedronMethod(v)};
  }
};
struct Triangles {
  static constexpr int variants = 3;
  template <class D>
  static auto make(int v) {
    return TriangleFEMForceField<D>{
        .youngModulus = {1000}, .poissonRatio = {0.3}, .thickness = 0.1, .method = TriangleMethod(v)};
  }
};
struct Bending {
  static constexpr int variants = 1;
  template <class D>
  static auto make(int) {
    return FastTriangularBendingSprings<D>{.bendingStiffness = 3};
  }
};

}  // namespace gpu_test
