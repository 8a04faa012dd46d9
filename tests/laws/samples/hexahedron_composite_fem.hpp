// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/hexahedron_composite_fem.hpp>
#include <sinew/mapping/hexahedron_composite_fem_mapping.hpp>
#include <sinew/mass/hexahedron_composite_fem_mass.hpp>

namespace sample {

// the body has no finer cells; their laws are in the tests of these components
template <class... A>
void prepare(HexahedronCompositeFEMForceField<A...>& c, Random&) {
  c.nbVirtualFinerLevels.reset();
}
template <class... A>
void prepare(HexahedronCompositeFEMMass<A...>& c, Random&) {
  c.nbVirtualFinerLevels.reset();
}
template <class... A>
void prepare(HexahedronCompositeFEMMapping<A...>& c, Random&) {
  c.nbVirtualFinerLevels.reset();
}

}  // namespace sample
