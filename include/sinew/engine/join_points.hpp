// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Points nearer to each other than a distance become one, in their mean: each in turn takes the nearest
/// point around it as long as there is one, weighted by the number of points in both.
struct JoinPoints {
  using Role = role::Engine;
  static constexpr std::string_view className = "JoinPoints";

  std::vector<Eigen::Vector3d> points{};
  double distance = 0;

  static constexpr auto fields() {
    using J = JoinPoints;
    return field_list(field("points", &J::points, "m", "points that are joined"),
                      field("distance", &J::distance, "m", "below which they are", range::nonNegative));
  }

  std::vector<Eigen::Vector3d> mergedPoints{};  // after update

  static constexpr auto outputs() {
    return field_list(field("mergedPoints", &JoinPoints::mergedPoints, "m", "what is left"));
  }

  /// Throws Error where there is no point; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void JoinPoints::update(std::string_view where) {
  check_fields(*this, where);
  if (points.empty())
    throw Error(text(where, ": ", className), "points is empty; link it to the points of a loader or state");
  mergedPoints = points;
  std::vector<int> count(points.size(), 1);  // of points in each
  for (std::size_t i = 0; i < mergedPoints.size();) {
    std::size_t nearest = i;
    double least = distance;
    for (std::size_t j = 0; j < mergedPoints.size(); ++j)
      if (const double d = (mergedPoints[i] - mergedPoints[j]).norm(); j != i && d < least)
        least = d, nearest = j;
    if (nearest == i) {
      ++i;
      continue;
    }
    mergedPoints[i] =
        (mergedPoints[i] * count[i] + mergedPoints[nearest] * count[nearest]) / (count[i] + count[nearest]);
    count[i] += count[nearest];
    mergedPoints.erase(mergedPoints.begin() + std::ptrdiff_t(nearest));
    count.erase(count.begin() + std::ptrdiff_t(nearest));
    if (nearest < i) --i;
  }
}

}  // namespace sinew
#endif
