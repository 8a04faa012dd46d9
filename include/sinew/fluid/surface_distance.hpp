// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/closest_points.hpp>
#include <sinew/core/immersed_body.hpp>
#include <sinew/fluid/cell_grid.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sinew::fluid {

/// Signed distances of the corners of cells from the surfaces of bodies, in cells, negative inside, as far as
/// `band`; the body and the element of its surface that are nearest. The lower corner of a cell has its
/// number. What is inside follows from how often a line along x crosses the surface, whichever way its
/// elements turn.
template <int N>
class SurfaceDistance {
 public:
  static constexpr double band = 2;

  std::vector<double> value{};
  std::vector<int> body{}, element{};  // -1 where none is near

  void init(CellGrid<N> const& grid) {
    grid_ = grid;
    value.assign(grid.size, band);
    body.assign(grid.size, -1);
    element.assign(grid.size, -1);
    distance_.assign(grid.size, band);
    nearest_.assign(grid.size, -1);
    crossed_.assign(grid.size, 0);
  }
  void clear() {
    std::fill(value.begin(), value.end(), band);
    std::fill(body.begin(), body.end(), -1);
    std::fill(element.begin(), element.end(), -1);
  }

  /// The body of a number comes to those before it; place(position) is in cells from the lower corner of the
  /// grid on.
  template <class Place>
  void add(ImmersedBody const& solid, int number, Place&& place) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
    for (auto const& points : solid.elements)
      for (std::size_t k = 0; k < axes<N>; ++k) {
        const Eigen::Vector3d x = place(solid.positions[std::size_t(points[k])]);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    Range all;
    if (!range(low, high, all)) return;
    forCorners(all, [&](std::size_t i, Eigen::Vector3d const&) {
      distance_[i] = band;
      nearest_[i] = -1;
      crossed_[i] = 0;
    });
    for (std::size_t e = 0; e < solid.elements.size(); ++e) {
      auto const& points = solid.elements[e];
      std::array<Eigen::Vector3d, axes<N>> x;
      for (std::size_t k = 0; k < axes<N>; ++k) x[k] = place(solid.positions[std::size_t(points[k])]);
      cross(x, points, all);
      approach(x, int(e));
    }
    // inside behind an odd number of crossings
    forRows(all, [&](std::ptrdiff_t row) {
      unsigned inside = 0;
      for (int p = all.low[0]; p <= all.high[0]; ++p) {
        const auto i = std::size_t(row + p);
        inside ^= crossed_[i];
        const double d = inside & 1 ? -distance_[i] : distance_[i];
        if (!(d < value[i])) continue;
        value[i] = d;
        body[i] = number;
        element[i] = nearest_[i];
      }
    });
  }

  /// Weights of the points of an element in the point of it that is nearest to x.
  template <class Place>
  static Eigen::Vector3d weights(ImmersedBody const& solid, int element, Eigen::Vector3d const& x,
                                 Place&& place) {
    std::array<Eigen::Vector3d, axes<N>> points;
    for (std::size_t k = 0; k < axes<N>; ++k)
      points[k] = place(solid.positions[std::size_t(solid.elements[std::size_t(element)][k])]);
    return closest_points<double>(std::array<Eigen::Vector3d, 1>{x}, points).weightsB;
  }

 private:
  CellGrid<N> grid_{};
  std::vector<double> distance_{};
  std::vector<int> nearest_{};
  std::vector<std::uint8_t> crossed_{};

  // corners from low to high; the corner at x = 0 has the place 1
  struct Range {
    Each<int, N> low{}, high{};
  };
  bool range(Eigen::Vector3d const& low, Eigen::Vector3d const& high, Range& r) const {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const double last = grid_.cells[c] + 1, a = std::ceil(low[Eigen::Index(c)] - band) + 1,
                   b = std::floor(high[Eigen::Index(c)] + band) + 1;
      if (!(a <= last && b >= 1)) return false;
      r.low[c] = int(std::max(a, 1.0));
      r.high[c] = int(std::min(b, last));
    }
    return true;
  }
  // f(index of the corner with x = 0 of the row)
  template <class F>
  void forRows(Range const& r, F&& f) const {
    for (int j = r.low[1]; j <= r.high[1]; ++j) {
      if constexpr (N == 2)
        f(j * grid_.stride[1]);
      else
        for (int k = r.low[2]; k <= r.high[2]; ++k) f(j * grid_.stride[1] + k * grid_.stride[2]);
    }
  }
  template <class F>
  void forCorners(Range const& r, F&& f) const {
    forRows(r, [&](std::ptrdiff_t row) {
      Eigen::Vector3d x(0, 0, 0);
      x[1] = double(row / grid_.stride[1] % (grid_.cells[1] + 2)) - 1;
      if constexpr (N == 3) x[2] = double(row / grid_.stride[2]) - 1;
      for (int p = r.low[0]; p <= r.high[0]; ++p) {
        x[0] = p - 1;
        f(std::size_t(row + p), x);
      }
    });
  }

  void approach(std::array<Eigen::Vector3d, axes<N>> const& x, int e) {
    Eigen::Vector3d low = x[0], high = x[0];
    for (auto const& p : x) low = low.cwiseMin(p), high = high.cwiseMax(p);
    Range r;
    if (!range(low, high, r)) return;
    // no nearer than the plane of the element
    Eigen::Vector3d normal(0, 0, 0);
    if constexpr (N == 3)
      normal = (x[1] - x[0]).cross(x[2] - x[0]);
    else
      normal = Eigen::Vector3d(x[0][1] - x[1][1], x[1][0] - x[0][0], 0);
    const double size = normal.norm();
    if (size > 0) normal /= size;
    forCorners(r, [&](std::size_t i, Eigen::Vector3d const& at) {
      if (std::abs(normal.dot(at - x[0])) >= distance_[i]) return;
      const double d =
          std::sqrt(closest_points<double>(std::array<Eigen::Vector3d, 1>{at}, x).squaredDistance);
      if (!(d < distance_[i])) return;
      distance_[i] = d;
      nearest_[i] = e;
    });
  }

  // Where rows cross an element. A row through an edge or a corner crosses one of the elements there: on
  // which side of an edge it is does not depend on the element.
  void cross(std::array<Eigen::Vector3d, axes<N>> const& x, std::array<Index, 3> const& points,
             Range const& all) {
    Range r = all;
    for (std::size_t c = 1; c < axes<N>; ++c) {
      double low = x[0][Eigen::Index(c)], high = low;
      for (auto const& p : x)
        low = std::min(low, p[Eigen::Index(c)]), high = std::max(high, p[Eigen::Index(c)]);
      r.low[c] = std::max(all.low[c], int(std::ceil(std::max(low, -1e6))) + 1);
      r.high[c] = std::min(all.high[c], int(std::floor(std::min(high, 1e6))) + 1);
    }
    forRows(r, [&](std::ptrdiff_t row) {
      const double y = double(row / grid_.stride[1] % (grid_.cells[1] + 2)) - 1;
      double at = 0;
      if constexpr (N == 2) {
        if ((x[0][1] <= y) == (x[1][1] <= y)) return;
        const double part = (y - x[0][1]) / (x[1][1] - x[0][1]);
        at = x[0][0] + part * (x[1][0] - x[0][0]);
      } else {
        const double z = double(row / grid_.stride[2]) - 1;
        // twice the areas between the row and each edge, beside the corner across it
        std::array<double, 3> areas;
        std::array<bool, 3> left;
        for (std::size_t k = 0; k < 3; ++k) {
          std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
          const bool swapped = points[a] > points[b];
          if (swapped) std::swap(a, b);
          const double area = (x[a][1] - y) * (x[b][2] - z) - (x[b][1] - y) * (x[a][2] - z);
          areas[k] = swapped ? -area : area;
          left[k] = (area >= 0) != swapped;
        }
        if (left[0] != left[1] || left[1] != left[2]) return;
        const double sum = areas[0] + areas[1] + areas[2];
        if (sum == 0) return;
        at = (areas[0] * x[0][0] + areas[1] * x[1][0] + areas[2] * x[2][0]) / sum;
      }
      // the first corner behind it
      const int p = std::max(all.low[0], int(std::floor(std::clamp(at, -1e6, 1e6))) + 2);
      if (p <= all.high[0]) crossed_[std::size_t(row + p)] ^= 1;
    });
  }
};

}  // namespace sinew::fluid
