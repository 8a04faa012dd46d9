// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// How far two sets of points are apart: d12 is the largest distance from a point of the first to the nearest
/// of the second, d21 the same the other way round, and their maximum the distance of Hausdorff.
struct HausdorffDistance {
  using Role = role::Engine;
  static constexpr std::string_view className = "HausdorffDistance";
  static constexpr bool sizedValues = true;

  std::vector<double> points1{}, points2{};
  int size = 3;

  static constexpr auto fields() {
    using E = HausdorffDistance;
    return field_list(field("points1", &E::points1, "m", "the first set"),
                      field("points2", &E::points2, "m", "the second set"),
                      size_of_values<E>());
  }

  // after update
  double d12 = 0, d21 = 0, maximum = 0;

  static constexpr auto outputs() {
    using E = HausdorffDistance;
    return field_list(field("d12", &E::d12, "m", "from the first to the second"),
                      field("d21", &E::d21, "m", "from the second to the first"),
                      field("max", &E::maximum, "m", "the larger of both"));
  }

  /// Throws Error where a set is empty or no set of whole points; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {

SINEW_ONCE void HausdorffDistance::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = count_values(at, "points1", points1, size),
                    m = count_values(at, "points2", points2, size);
  if (n == 0 || m == 0)
    throw Error(
        at, text(n == 0 ? "points1" : "points2", " is empty; link it to the points of a loader or state"));
  auto farthest =
      [&](std::vector<double> const& a, std::size_t na, std::vector<double> const& b, std::size_t nb) {
        auto point = [&](std::vector<double> const& list, std::size_t i) {
          return Eigen::Map<Eigen::VectorXd const>(list.data() + i * std::size_t(size), size);
        };
        double most = 0;
        for (std::size_t i = 0; i < na; ++i) {
          double least = std::numeric_limits<double>::infinity();
          for (std::size_t j = 0; j < nb; ++j)
            least = std::min(least, (point(a, i) - point(b, j)).squaredNorm());
          most = std::max(most, least);
        }
        return std::sqrt(most);
      };
  d12 = farthest(points1, n, points2, m);
  d21 = farthest(points2, m, points1, n);
  maximum = std::max(d12, d21);
}

}  // namespace sinew
#endif
