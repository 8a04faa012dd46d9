// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/engine/roi.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The points in one box along the axes, its faces included, that are not in another: a layer, where the
/// second box is inside the first.
template <class D>
struct PairBoxROI {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "PairBoxROI";
  static constexpr std::string_view aliases = "PairBoxRoi";
  using Box = Vec<double, 6>;

  std::optional<Box> inclusiveBox{}, includedBox{};
  typename D::VecCoord position{};

  static constexpr auto fields() {
    using R = PairBoxROI;
    return field_list(
        field("inclusiveBox",
              &R::inclusiveBox,
              "m",
              "two opposite corners of the box around the points: xmin ymin zmin xmax ymax zmax"),
        field("includedBox", &R::includedBox, "m", "the same of the box without the points"),
        field("position", &R::position, "m", "points to choose from").also("rest_position meshPosition"));
  }

  // after update
  std::vector<int> indices{};
  typename D::VecCoord pointsInROI{};

  static constexpr auto outputs() {
    using R = PairBoxROI;
    return field_list(
        field("indices", &R::indices, "", "the points in the first box and not in the second"),
        field("pointsInROI", &R::pointsInROI, "m", "positions of these points").also("pointsInBox"));
  }

  /// Throws Error when a box or the points are missing; the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<PairBoxROI>());
    if (!inclusiveBox || !includedBox) throw Error(at, "a box is missing; give inclusiveBox and includedBox");
    if (position.empty())
      throw Error(at, "position is empty; link it to the points of a loader, topology or state");
    indices.clear(), pointsInROI.clear();
    for (std::size_t i = 0; i < position.size(); ++i) {
      if (!holds(*inclusiveBox, position[i]) || holds(*includedBox, position[i])) continue;
      indices.push_back(int(i));
      pointsInROI.push_back(position[i]);
    }
  }

 private:
  static bool holds(Box const& box, typename D::Coord const& x) {
    return box_holds<D::spatial>(box, D::center(x).template cast<double>());
  }
};

}  // namespace sinew
