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
    return rod_section_fields<S>(
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
    const std::vector<RodSection> made{rod_section(*this)};
    rod_beams(text(where, ": ", className), made);
    section = made;
  }
};

}  // namespace sinew
