// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>

#include <Eigen/Core>

#include <array>
#include <string_view>

namespace sinew {

/// To what the axes of a center belong where it has several articulations: each to the body as those before
/// it have turned it, all to the body that bears, or all to the one that is borne. SOFA's numbers stand for
/// them too.
enum class ArticulationProcess { sequential, onParent, onChild };
inline constexpr std::array<std::string_view, 3> enum_names(ArticulationProcess) {
  return {"sequential", "onParent", "onChild"};
}
inline constexpr std::array<std::array<std::string_view, 2>, 3> enum_aliases(ArticulationProcess) {
  return {{{"0", "sequential"}, {"1", "onParent"}, {"2", "onChild"}}};
}

/// Where two bodies of an ArticulatedSystemMapping are joined.
struct ArticulationCenter {
  int parentIndex = 0, childIndex = 0;
  Eigen::Vector3d posOnParent{0, 0, 0}, posOnChild{0, 0, 0};
  ArticulationProcess articulationProcess = ArticulationProcess::sequential;

  static constexpr auto fields() {
    using A = ArticulationCenter;
    return field_list(
        field("parentIndex", &A::parentIndex, "", "body that bears", range::nonNegative),
        field("childIndex", &A::childIndex, "", "body that is borne", range::nonNegative),
        field("posOnParent", &A::posOnParent, "m", "the center, in axes of the body that bears"),
        field("posOnChild", &A::posOnChild, "m", "the center, in axes of the body that is borne"),
        field("articulationProcess",
              &A::articulationProcess,
              "",
              "to what axes belong: each follows the articulation before it, or all follow a body"));
  }
};

/// One way in which the two bodies of a center move against each other.
struct Articulation {
  int center = 0, articulationIndex = 0;
  bool rotation = false, translation = false;
  Eigen::Vector3d axis{1, 0, 0};

  static constexpr auto fields() {
    using A = Articulation;
    return field_list(
        field("center", &A::center, "", "the center, by its number in `centers`", range::nonNegative),
        field("articulationIndex", &A::articulationIndex, "", "the value that moves it", range::nonNegative)
            .numbersOf(Of::parentPoints),
        field("rotation", &A::rotation, "", "the value is an angle [rad] about the axis"),
        field("translation", &A::translation, "", "the value is a length [m] along the axis"),
        field("axis", &A::axis, "", "axis, of any length but 0").also("rotationAxis"));
  }
};

}  // namespace sinew
