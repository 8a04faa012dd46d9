// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// A length of a wire that is a helix at rest, for the wireMaterials of a WireRestShape: the tip of a guide
/// wire, say, an arc where spireHeight is 0. It goes on from what is before it without a kink, and bends
/// towards -z of the frames. (In SOFA a helix that rises has a kink where it begins.)
struct RodSpireSection {
  using Role = role::Engine;
  static constexpr std::string_view className = "RodSpireSection";

  double length = 1;
  double youngModulus = 5000, poissonRatio = 0.49, massDensity = 1;
  double radius = 1, innerRadius = 0;
  int nbBeams = 5, nbEdgesCollis = 20;
  double spireDiameter = 0.1, spireHeight = 0.01;

  static constexpr auto fields() {
    using S = RodSpireSection;
    return field_list(
        field("length", &S::length, "m", "along the wire", range::positive),
        field("youngModulus", &S::youngModulus, "Pa", "stiffness of the material", range::positive),
        field("poissonRatio",
              &S::poissonRatio,
              "",
              "lateral contraction per strain",
              Range{.low = -1, .high = 0.5, .openLow = true}),
        field("massDensity", &S::massDensity, "kg/m^3", "mass of a volume", range::positive),
        field("radius", &S::radius, "m", "of the section", range::positive),
        field("innerRadius", &S::innerRadius, "m", "of the hole in it", range::nonNegative),
        field("nbBeams", &S::nbBeams, "", "beams of equal length", range::atLeast(1)),
        field("nbEdgesCollis", &S::nbEdgesCollis, "", "edges for collisions", range::atLeast(1)),
        field("spireDiameter", &S::spireDiameter, "m", "of the helix", range::positive),
        field("spireHeight", &S::spireHeight, "m", "its rise in a turn", range::nonNegative));
  }

  // after update
  std::vector<RodSection> section{};

  static constexpr auto outputs() {
    return field_list(field("section", &RodSpireSection::section, "", "one section of a wire"));
  }

  /// Throws Error for a hole as wide as the section, or beams of more than half a turn.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::vector<RodSection> made{{.length = length,
                                        .youngModulus = youngModulus,
                                        .poissonRatio = poissonRatio,
                                        .massDensity = massDensity,
                                        .radius = radius,
                                        .innerRadius = innerRadius,
                                        .nbBeams = nbBeams,
                                        .nbEdgesCollis = nbEdgesCollis,
                                        .spireDiameter = spireDiameter,
                                        .spireHeight = spireHeight}};
    rod_beams(text(where, ": ", className), made);
    section = made;
  }
};

}  // namespace sinew
