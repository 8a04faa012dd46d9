// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/tetrahedron_hyperelasticity.hpp>

namespace gpu_test {

using namespace sinew;

/// The materials, and one of them with a tangent without negative eigenvalues.
struct Hyperelasticity {
  static constexpr int variants = 10;
  static constexpr double crumpled = 0.05;
  static constexpr bool inverted = false;
  template <class D>
  static auto make(int v) {
    using M = HyperelasticMaterial;
    const M material = M(v < 9 ? v : int(M::NeoHookean));
    std::vector<double> parameters{400, 900};
    if (material == M::MooneyRivlin) parameters = {150, 60, 900};
    if (material == M::Ogden) parameters = {300, 1.7, 100, -2.2, 900};
    if (material == M::VerondaWestman) parameters = {200, 2, 900};
    if (material == M::Costa) parameters = {100, 900, 4, 2, 3, 2.5, 1.5, 2};
    if (material == M::HolzapfelGasserOgden) parameters = {300, 900, 200, 0.8, 0.1};
    return TetrahedronHyperelasticityFEMForceField<D>{
        .materialName = material, .parameterSet = parameters, .matrixRegularization = v == 9};
  }
};

}  // namespace gpu_test
