// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// A straight length of a wire, for the wireMaterials of a WireRestShape.
struct RodStraightSection {
  using Role = role::Engine;
  static constexpr std::string_view className = "RodStraightSection";

  double length = 1;
  double youngModulus = 5000, poissonRatio = 0.49, massDensity = 1;
  double radius = 1, innerRadius = 0;
  int nbBeams = 5, nbEdgesCollis = 20;

  static constexpr auto fields() {
    using S = RodStraightSection;
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
        field("nbEdgesCollis", &S::nbEdgesCollis, "", "edges for collisions", range::atLeast(1)));
  }

  // after update
  std::vector<RodSection> section{};

  static constexpr auto outputs() {
    return field_list(field("section", &RodStraightSection::section, "", "one section of a wire"));
  }

  /// Throws Error for a hole as wide as the section.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::vector<RodSection> made{{.length = length,
                                        .youngModulus = youngModulus,
                                        .poissonRatio = poissonRatio,
                                        .massDensity = massDensity,
                                        .radius = radius,
                                        .innerRadius = innerRadius,
                                        .nbBeams = nbBeams,
                                        .nbEdgesCollis = nbEdgesCollis}};
    rod_beams(text(where, ": ", className), made);
    section = made;
  }
};

}  // namespace sinew
