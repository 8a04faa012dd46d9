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

  static constexpr auto fields() { return rod_section_fields<RodStraightSection>(); }

  // after update
  std::vector<RodSection> section{};

  static constexpr auto outputs() {
    return field_list(field("section", &RodStraightSection::section, "", "one section of a wire"));
  }

  /// Throws Error for a hole as wide as the section.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::vector<RodSection> made{rod_section(*this)};
    rod_beams(text(where, ": ", className), made);
    section = made;
  }
};

}  // namespace sinew
