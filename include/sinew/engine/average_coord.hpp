// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <vector>

namespace sinew {

/// The mean of some points of a state, or of all.
template <class D>
struct AverageCoord {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(!D::rigid, "AverageCoord is over points");
  static constexpr std::string_view className = "AverageCoord";
  static constexpr bool ofPositions = true;  // where the state is, and not where it rests

  typename D::VecCoord position{};
  std::vector<int> indices{};

  static constexpr auto fields() {
    using A = AverageCoord;
    return field_list(
        field("position", &A::position, "m", "points"),
        field("indices", &A::indices, "", "those that count; none for all", range::nonNegative));
  }

  typename D::Coord average = D::zero();  // after update

  static constexpr auto outputs() {
    return field_list(field("average", &AverageCoord::average, "m", "their mean"));
  }

  /// Throws Error where there is no point, or an index is out of range; the output then stays.
  void update(std::string_view where) {
    check_fields(*this, where);
    const auto at = [&] { return text(where, ": ", component_name<AverageCoord>()); };
    check_points(at, "indices", indices, position.size());
    if (position.empty())
      throw Error(at(), "there is no point; put it into the node of a state that has some");
    typename D::Coord sum = D::zero();
    for (const int i : indices) sum += position[std::size_t(i)];
    if (indices.empty())
      for (auto const& x : position) sum += x;
    average = sum / typename D::Real(indices.empty() ? position.size() : indices.size());
  }
};

}  // namespace sinew
