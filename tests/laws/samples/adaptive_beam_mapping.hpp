// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/adaptive_beam_mapping.hpp>

namespace sample {

/// Points along 54 beams, those of the edges of the body, and beside them.
template <class I, class O>
void prepare(AdaptiveBeamMapping<I, O>& c, Random& random) {
  c.interpolation = rod_beams("sample", {{.length = 60, .nbBeams = 54, .spireDiameter = 4}});
  c.nbPointsPerBeam = 0;
  c.points.clear();
  for (int i = 0; i < 40; ++i) c.points.emplace_back(random(0, 53.9), random(), random());
}
template <class I, class O>
constexpr std::size_t child_points(AdaptiveBeamMapping<I, O> const&) {
  return 0;
}

}  // namespace sample
