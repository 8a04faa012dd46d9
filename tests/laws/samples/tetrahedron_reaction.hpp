// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/tetrahedron_reaction.hpp>

namespace sample {

template <class D>
void complete(TetrahedronReactionFEMForceField<D>& c, Random& random) {
  take_parameters(c.parameterSet, c.reaction, random);
  c.recovery.assign(1, random());
}

}  // namespace sample
