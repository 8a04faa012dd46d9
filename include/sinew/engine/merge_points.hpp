// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <numeric>
#include <vector>

namespace sinew {

/// The points of two objects as one list: the first, then the second; with mappingX2 those of the second in
/// the place of points of the first.
template <class D>
struct MergePoints {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "MergePoints";

  typename D::VecCoord position1{}, position2{};
  std::vector<int> mappingX2{};

  static constexpr auto fields() {
    using M = MergePoints;
    return field_list(field("position1", &M::position1, "m", "points of the first object"),
                      field("position2", &M::position2, "m", "points of the second object"),
                      field("mappingX2",
                            &M::mappingX2,
                            "",
                            "points of the first object whose place those of the second take, one each",
                            range::nonNegative));
  }

  // after update
  std::vector<int> indices1{}, indices2{};
  typename D::VecCoord points{};

  static constexpr auto outputs() {
    using M = MergePoints;
    return field_list(field("indices1", &M::indices1, "", "numbers of the points of the first object"),
                      field("indices2", &M::indices2, "", "numbers of the points of the second object"),
                      field("points", &M::points, "m", "all points"));
  }

  /// Throws Error where mappingX2 names a missing point, or not one for each of the second object; the
  /// outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<MergePoints>());
    check_numbers(at, "mappingX2", mappingX2, position1.size(), "points", "position1");
    if (!mappingX2.empty() && mappingX2.size() > position2.size())
      throw Error(at,
                  text("mappingX2 has ",
                       mappingX2.size(),
                       " numbers for ",
                       position2.size(),
                       " points of position2; give one for each"));
    points = position1;
    indices1.clear(), indices2.clear();
    if (mappingX2.empty()) {
      points.insert(points.end(), position2.begin(), position2.end());
      indices1.resize(position1.size()), indices2.resize(position2.size());
      std::iota(indices1.begin(), indices1.end(), 0);
      std::iota(indices2.begin(), indices2.end(), int(position1.size()));
      return;
    }
    std::vector<bool> replaced(points.size());
    for (std::size_t i = 0; i < mappingX2.size(); ++i) {
      points[std::size_t(mappingX2[i])] = position2[i];
      replaced[std::size_t(mappingX2[i])] = true;
    }
    for (std::size_t i = 0; i < points.size(); ++i) (replaced[i] ? indices2 : indices1).push_back(int(i));
  }
};

}  // namespace sinew
