// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/tetrahedron_hyperelasticity.hpp>

namespace sample {

template <class D>
void complete(TetrahedronHyperelasticityFEMForceField<D>& c, Random& random) {
  take_parameters(c.parameterSet, c.materialName, random);
  using Directions = std::vector<Eigen::Vector3d>;
  auto direction = [&] { return Eigen::Vector3d(random(), random(), random()); };
  c.anisotropyDirections = c.fiberDirections = c.sheetDirections = Directions{};
  if (!has_directions(c.materialName)) return;
  // fibres that are pulled hard have no tangent for numbers of this size
  if (c.materialName == HyperelasticMaterial::HolzapfelGasserOgden) {
    c.parameterSet[3] = random(0.1, 1);
    c.parameterSet[4] = random(0, 1. / 3);
    c.anisotropyDirections = Directions{direction(), direction()};
  }
  c.fiberDirections = Directions{direction()};
  c.sheetDirections = Directions{direction()};
  c.matrixRegularization = false;
}

}  // namespace sample
