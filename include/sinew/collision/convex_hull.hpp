// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/data_types.hpp>

#include <string_view>
#include <vector>

namespace sinew {

/// The convex hull of points in body axes [m]; they may be coplanar, collinear or one. Points inside do no
/// harm but cost time: a support takes one product each.
class ConvexHull {
 public:
  /// Throws Error where there is no point, or one that is not finite.
  explicit ConvexHull(std::vector<Vec<double, 3>> corners, std::string_view where = "ConvexHull");
  /// The box of half such sides along the axes, around the origin.
  static ConvexHull box(Vec<double, 3> const& half, std::string_view where = "ConvexHull");
  std::vector<Vec<double, 3>> const& points() const { return points_; }
  Vec<double, 3> const& middle() const { return middle_; }
  /// Of the ball around middle().
  double radius() const { return radius_; }
  /// Of the ball around the origin of the axes.
  double reach() const { return reach_; }
  bool isBox() const { return isBox_; }
  /// The first point that is farthest along d.
  std::size_t support(Vec<double, 3> const& d) const;

 private:
  std::vector<Vec<double, 3>> points_;
  Vec<double, 3> middle_{0, 0, 0};
  double radius_ = 0, reach_ = 0;
  bool isBox_ = false;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <algorithm>
#include <utility>

namespace sinew {

SINEW_ONCE ConvexHull::ConvexHull(std::vector<Vec<double, 3>> corners, std::string_view where)
    : points_(std::move(corners)) {
  if (points_.empty()) throw Error(where, "a convex hull has no points; give it at least 1");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].allFinite())
      throw Error(
          where, text("point ", i, " of a convex hull is not finite; mend the mesh or the table it is from"));
    middle_ += points_[i] / double(points_.size());
  }
  for (auto const& p : points_) {
    radius_ = std::max(radius_, (p - middle_).norm());
    reach_ = std::max(reach_, p.norm());
  }
}

SINEW_ONCE ConvexHull ConvexHull::box(Vec<double, 3> const& half, std::string_view where) {
  std::vector<Vec<double, 3>> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back({k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]});
  ConvexHull hull(std::move(corners), where);
  hull.isBox_ = true;
  return hull;
}

SINEW_ONCE std::size_t ConvexHull::support(Vec<double, 3> const& d) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (points_[i].dot(d) > points_[best].dot(d)) best = i;
  return best;
}

}  // namespace sinew
#endif
