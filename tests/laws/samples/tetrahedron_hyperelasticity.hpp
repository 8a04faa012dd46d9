// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/tetrahedron_hyperelasticity.hpp>

namespace sample {

template <class D>
void complete(TetrahedronHyperelasticityFEMForceField<D>& c, Random& random) {
  take_parameters(c.parameterSet, c.materialName, random);
}

}  // namespace sample
