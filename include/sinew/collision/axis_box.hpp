// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {

/// Box with sides along the axes, the room that a primitive takes [m]; by default the empty one, which lies
/// nowhere: it overlaps nothing, and including it changes nothing.
template <class Real>
struct BasicAxisBox {
  using Point = Eigen::Matrix<Real, 3, 1>;

  Point min = Point::Constant(std::numeric_limits<Real>::infinity());
  Point max = Point::Constant(-std::numeric_limits<Real>::infinity());

  bool empty() const { return !(min[0] <= max[0] && min[1] <= max[1] && min[2] <= max[2]); }

  void include(Point const& p) {
    for (int c = 0; c < 3; ++c) min[c] = std::min(min[c], p[c]), max[c] = std::max(max[c], p[c]);
  }
  void include(BasicAxisBox const& other) {
    for (int c = 0; c < 3; ++c)
      min[c] = std::min(min[c], other.min[c]), max[c] = std::max(max[c], other.max[c]);
  }

  /// The box and all that is within `margin` of it along the axes.
  BasicAxisBox grown(Real margin) const {
    BasicAxisBox box;
    for (int c = 0; c < 3; ++c) box.min[c] = min[c] - margin, box.max[c] = max[c] + margin;
    return box;
  }
  /// Around this box and `end`, between which it moves on a straight line: for continuous queries.
  BasicAxisBox swept(BasicAxisBox const& end) const {
    BasicAxisBox box = *this;
    box.include(end);
    return box;
  }

  /// Whether the gap along each axis is at most `margin`; boxes that touch overlap.
  bool overlaps(BasicAxisBox const& other, Real margin = 0) const {
    for (int c = 0; c < 3; ++c)
      if (!(min[c] - other.max[c] <= margin && other.min[c] - max[c] <= margin)) return false;
    return true;
  }
  bool contains(Point const& p) const { return overlaps({p, p}); }

  Point center() const {
    Point p;
    for (int c = 0; c < 3; ++c) p[c] = Real(0.5) * min[c] + Real(0.5) * max[c];
    return p;
  }
  /// Half of the surface, xy + yz + zx [m^2], to which the chance that a random line hits the box is
  /// proportional; 0 when empty.
  Real halfArea() const {
    if (empty()) return 0;
    const Real x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
    return x * y + y * z + z * x;
  }

  /// Square of the distance between the nearest points of the boxes [m^2], 0 where they overlap.
  Real squaredDistance(BasicAxisBox const& other) const {
    Real sum = 0;
    for (int c = 0; c < 3; ++c) {
      const Real gap = std::max({min[c] - other.max[c], other.min[c] - max[c], Real(0)});
      sum += gap * gap;
    }
    return sum;
  }
  Real distance(BasicAxisBox const& other) const { return std::sqrt(squaredDistance(other)); }

  /// Where the ray origin + t direction, 0 <= t <= end, enters the box; infinity where it does not. A ray
  /// along a side touches.
  Real rayEntry(Point const& origin, Point const& direction, Real end) const {
    Real from = 0, to = end;
    for (int c = 0; c < 3; ++c) {
      if (direction[c] == 0) {
        if (!(min[c] <= origin[c] && origin[c] <= max[c])) return std::numeric_limits<Real>::infinity();
        continue;
      }
      const bool up = direction[c] > 0;
      from = std::max(from, ((up ? min[c] : max[c]) - origin[c]) / direction[c]);
      to = std::min(to, ((up ? max[c] : min[c]) - origin[c]) / direction[c]);
    }
    return from <= to ? from : std::numeric_limits<Real>::infinity();
  }

  bool operator==(BasicAxisBox const& other) const {
    for (int c = 0; c < 3; ++c)
      if (min[c] != other.min[c] || max[c] != other.max[c]) return false;
    return true;
  }
};

using AxisBox = BasicAxisBox<double>;

}  // namespace sinew
