// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mass/adaptive_beam_force_field_and_mass.hpp>

namespace sample {

/// A beam for each edge of the body, of its own.
template <class... A>
void give_masses(AdaptiveBeamForceFieldAndMass<A...>& c, std::size_t, Random& random) {
  for (std::size_t i = 0; i < 54; ++i)
    c.interpolation.push_back(rod_beams("sample",
                                        {{.length = random(0.5, 2),
                                          .radius = random(0.1, 0.5),
                                          .nbBeams = 1,
                                          .spireDiameter = random(2, 3),
                                          .spireHeight = random(0, 1)}})[0]);
}

}  // namespace sample
