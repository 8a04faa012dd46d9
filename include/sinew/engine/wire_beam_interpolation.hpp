// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// The beams of a wire: those of a WireRestShape, which an AdaptiveBeamForceField, an AdaptiveBeamMass, an
/// AdaptiveBeamMapping and an InterventionalRadiologyController take from here.
template <class D>
struct WireBeamInterpolation {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: WireBeamInterpolation is for frames in space (Rigid3d).");
  static constexpr std::string_view className = "WireBeamInterpolation";

  std::vector<RodBeam> wireRestShape{};

  static constexpr auto fields() {
    return field_list(
        field("wireRestShape", &WireBeamInterpolation::wireRestShape, "", "the beams of the shape at rest")
            .also("WireRestShape"));
  }

  // after update
  std::vector<RodBeam> beams{};

  static constexpr auto outputs() {
    return field_list(field("beams", &WireBeamInterpolation::beams, "", "from frame to frame"));
  }

  /// Throws Error where there are none.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<WireBeamInterpolation>());
    if (wireRestShape.empty()) throw Error(at, "there are no beams; link WireRestShape to that of a wire");
    check_beams(at, wireRestShape);
    beams = wireRestShape;
  }
};

}  // namespace sinew
