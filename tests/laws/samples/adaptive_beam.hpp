// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>

namespace sample {

/// A beam for each edge of the body, of its own.
inline std::vector<RodBeam> some_beams(Random& random) {
  std::vector<RodBeam> beams;
  for (int i = 0; i < 54; ++i)
    beams.push_back(rod_beams("sample",
                              {{.length = random(0.5, 2),
                                .poissonRatio = random(0, 0.4),
                                .radius = random(0.1, 0.5),
                                .nbBeams = 1,
                                .spireDiameter = random(2, 3),
                                .spireHeight = random(0, 1)}})[0]);
  return beams;
}
template <class... A>
void prepare(AdaptiveBeamForceField<A...>& c, Random& random) {
  c.interpolation = some_beams(random);
}
template <class D>
void rest_at(AdaptiveBeamForceField<D>& c, typename D::VecCoord const& rest, Body const& body) {
  for (std::size_t b = 0; b < body.edges.size(); ++b) {
    auto const &x0 = rest[std::size_t(body.edges[b][0])], &x1 = rest[std::size_t(body.edges[b][1])];
    const Eigen::Quaterniond q0 = x0.orientation.template cast<double>(),
                             q1 = x1.orientation.template cast<double>();
    c.interpolation[b].chord = q0.conjugate() * (x1.center - x0.center).template cast<double>();
    c.interpolation[b].rotation = (q0.conjugate() * q1).coeffs();
  }
}
template <class... A>
void give_masses(AdaptiveBeamMass<A...>& c, std::size_t, Random& random) {
  c.interpolation = some_beams(random);
}
template <class... A>
constexpr bool has_row_sums(AdaptiveBeamMass<A...> const&) {
  return false;
}

}  // namespace sample
