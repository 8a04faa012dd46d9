// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The positions of some points, in the order of their indices. A place that two of them share is there once,
/// as in SOFA.
template <class D>
struct PointsFromIndices {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "PointsFromIndices";

  typename D::VecCoord position{};
  std::vector<int> indices{};

  static constexpr auto fields() {
    using P = PointsFromIndices;
    return field_list(field("position", &P::position, "m", "points to choose from"),
                      field("indices", &P::indices, "", "those that are chosen", range::nonNegative));
  }

  typename D::VecCoord chosen{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("indices_position", &PointsFromIndices::chosen, "m", "positions of the chosen points"));
  }

  /// Throws Error where an index is out of range; the output then stays.
  void update(std::string_view where) {
    static_assert(!D::rigid, "Sinew: PointsFromIndices chooses points");
    check_fields(*this, where);
    for (const int i : indices)
      if (std::size_t(i) >= position.size())
        throw Error(text(where, ": ", component_name<PointsFromIndices>()),
                    text("indices has ",
                         i,
                         ", but position has ",
                         position.size(),
                         " points, numbered from 0; correct the index, or link position to other points"));
    chosen.clear();
    std::set<std::array<typename D::Real, D::spatial>> there;
    for (const int i : indices) {
      auto const& x = position[std::size_t(i)];
      std::array<typename D::Real, D::spatial> place;
      std::copy_n(x.data(), place.size(), place.begin());
      if (there.insert(place).second) chosen.push_back(x);
    }
  }
};

}  // namespace sinew
