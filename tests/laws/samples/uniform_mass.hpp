// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mass/uniform_mass.hpp>

namespace sample {

template <class D>
void give_masses(UniformMass<D>& c, std::size_t, Random& random) {
  randomise(c.vertexMass.emplace(), range::positive, random);
}

}  // namespace sample
