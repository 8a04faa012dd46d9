// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace bench {

/// Operations of one element, as its law is written: force, product with the tangent, and blocks of the
/// matrix, one of each two that mirror each other; with their sums into the vectors and the matrix. They are
/// counted by running the law over Counted, in a file that nvcc does not compile: that is no number of a
/// device.
struct LawFlops {
  double force, dforce, blocks;
};
LawFlops spring_flops();        // of RegularGridSpringForceField
LawFlops tetrahedron_flops();   // of TetrahedronFEMForceField with the method `gradient`
LawFlops hexahedron_flops();    // of HexahedronFEMForceField with the method `large`
LawFlops hyperelastic_flops();  // of TetrahedronHyperelasticityFEMForceField, Neo-Hookean

}  // namespace bench
