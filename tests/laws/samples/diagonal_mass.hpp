// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mass/diagonal_mass.hpp>

namespace sample {

template <class D>
void give_masses(DiagonalMass<D>& c, std::size_t points, Random& random) {
  c.vertexMass.resize(points);
  for (auto& m : c.vertexMass) randomise(m, range::positive, random);
}

}  // namespace sample
