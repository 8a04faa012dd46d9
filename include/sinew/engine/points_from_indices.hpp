// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
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
  std::vector<std::size_t> order{};
  std::vector<bool> stays{};

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
    // of those at one place, which lie side by side when sorted, the first of the list stays
    const auto place = [this](std::size_t k) {
      std::array<typename D::Real, D::spatial> at;
      std::copy_n(position[std::size_t(indices[k])].data(), at.size(), at.begin());
      return at;
    };
    order.resize(indices.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto x = place(a), y = place(b);
      return x != y ? x < y : a < b;
    });
    stays.assign(indices.size(), true);
    for (std::size_t k = 1; k < order.size(); ++k) stays[order[k]] = place(order[k]) != place(order[k - 1]);
    chosen.clear();
    for (std::size_t k = 0; k < indices.size(); ++k)
      if (stays[k]) chosen.push_back(position[std::size_t(indices[k])]);
  }
};

}  // namespace sinew
