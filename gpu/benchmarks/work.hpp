// SPDX-License-Identifier: BSL-1.0
// The arithmetic of the scenes that are measured on a GPU, counted on the host by a file that nvcc does not
// compile: what counts is no number of a device.
#pragma once

#include "../../benchmarks/run/law_flops.hpp"

namespace bench {

LawFlops spring_flops();        // of RegularGridSpringForceField
LawFlops tetrahedron_flops();   // of TetrahedronFEMForceField with the method `gradient`
LawFlops hexahedron_flops();    // of HexahedronFEMForceField with the method `large`
LawFlops hyperelastic_flops();  // of TetrahedronHyperelasticityFEMForceField, Neo-Hookean

}  // namespace bench
