// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/element_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace sinew {

/// Finds the element around a point or nearest to it, through a uniform grid of cells of about one element
/// each.
template <class Fit>
struct ElementLocator {
  struct Located {
    int element = -1;  // none, where all are flat
    decltype(std::declval<Fit const&>().fit(Eigen::Vector3d())) fit{-std::numeric_limits<double>::infinity(),
                                                                    {}};
  };

  ElementLocator(std::span<Eigen::Vector3d const> points, std::span<typename Fit::Points const> list) {
    if (list.empty()) return;
    low.setConstant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = -low;
    elements.reserve(list.size());
    for (auto const& e : list) {
      elements.emplace_back(points, e);
      low = min_of(low, elements.back().low);
      high = max_of(high, elements.back().high);
    }
    // the directions in which a sheet or a string has no extent do not count; where all points are at one
    // place, none does
    const double longest = (high - low).maxCoeff();
    const bool spread = longest > 0 && std::isfinite(longest);
    const Eigen::Vector3d extent =
        spread ? Eigen::Vector3d((high - low) / longest) : Eigen::Vector3d(0, 0, 0);
    double measure = 1;
    int directions = 0;
    for (int c = 0; c < 3; ++c)
      if (extent[c] > 1e-3) measure *= extent[c], ++directions;
    if (directions == 0) directions = 1;
    const double relative =
        std::max(std::pow(measure / double(elements.size()), 1.0 / directions), 1.0 / 512);
    if (spread) cell = relative * longest;
    for (std::size_t c = 0; c < 3; ++c) count[c] = std::clamp(int(extent[Index(c)] / relative) + 1, 1, 513);

    // two passes: count, then fill, so that cell c holds members[start[c]] ... in the order of the elements
    start.assign(std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]) + 1, 0);
    for (int pass = 0; pass < 2; ++pass) {
      std::vector<int> at = start;
      for (std::size_t e = 0; e < elements.size(); ++e)
        forCells(cellOf(elements[e].low), cellOf(elements[e].high), [&](std::size_t c) {
          if (pass == 0)
            ++start[c + 1];
          else
            members[std::size_t(at[c]++)] = int(e);
        });
      if (pass == 0) {
        for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
        members.resize(std::size_t(start.back()));
      }
    }
  }

  /// The element that contains p; outside all, the nearest one. Where the score of a kind of element is no
  /// distance, the best of those in the nearest cells.
  Located locate(Eigen::Vector3d const& p) const {
    Located best;
    if (elements.empty()) return best;
    auto visit = [&](int i, int j, int k) {
      const Eigen::Vector3d corner = low + cell * Eigen::Vector3d(i, j, k);
      const double far = squared_distance(p, corner, corner + Eigen::Vector3d(cell, cell, cell));
      if (Fit::isDistance && far > best.fit.score * best.fit.score) return;
      const std::size_t c = number(i, j, k);
      for (int m = start[c]; m < start[c + 1]; ++m) {
        const int e = members[std::size_t(m)];
        Fit const& element = elements[std::size_t(e)];
        if (Fit::isDistance && element.squaredDistance(p) > best.fit.score * best.fit.score) continue;
        const auto fit = element.fit(p);
        if (fit.score > best.fit.score || (fit.score == best.fit.score && e < best.element)) best = {e, fit};
      }
    };
    // shells of cells around that of p. All that is behind the shell r is r cells from the cell of p, or from
    // the nearest one of the grid, and the angle there is obtuse
    const auto home = cellOf(p);
    const Eigen::Vector3d size = cell * Eigen::Vector3d(count[0], count[1], count[2]);
    const double away = squared_distance(p, low, low + size);
    const int maximum = std::max({count[0], count[1], count[2]});
    int last = maximum;
    for (int r = 0; r <= last; ++r) {
      forShell(home, r, visit);
      if (best.fit.score == 0) break;
      if constexpr (Fit::isDistance) {
        if (best.fit.score * best.fit.score <= away + r * cell * r * cell) break;
      } else {
        if (best.element >= 0 && last == maximum) last = std::min(last, r + 1);
      }
    }
    return best;
  }

 private:
  std::vector<Fit> elements{};
  Eigen::Vector3d low{0, 0, 0};
  double cell = 1;
  std::array<int, 3> count{1, 1, 1};
  std::vector<int> start{}, members{};

  static double squared_distance(Eigen::Vector3d const& p, Eigen::Vector3d const& lo,
                                 Eigen::Vector3d const& hi) {
    return max_of(max_of(lo - p, p - hi), Eigen::Vector3d(0, 0, 0)).squaredNorm();
  }
  std::array<int, 3> cellOf(Eigen::Vector3d const& p) const {
    std::array<int, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = int(std::clamp((p[Index(k)] - low[Index(k)]) / cell, 0.0, double(count[k] - 1)));
    return c;
  }
  template <class F>
  void forCells(std::array<int, 3> a, std::array<int, 3> b, F&& f) const {
    for (std::size_t k = 0; k < 3; ++k) a[k] = std::max(a[k], 0), b[k] = std::min(b[k], count[k] - 1);
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int x = a[0]; x <= b[0]; ++x) f(number(x, y, z));
  }
  // the cells that are r away from `home` in some direction and not more in any
  template <class F>
  void forShell(std::array<int, 3> const& home, int r, F&& f) const {
    std::array<int, 3> a, b;
    for (std::size_t k = 0; k < 3; ++k)
      a[k] = std::max(home[k] - r, 0), b[k] = std::min(home[k] + r, count[k] - 1);
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y) {
        const bool whole = r == 0 || std::abs(z - home[2]) == r || std::abs(y - home[1]) == r;
        if (whole) {
          for (int x = a[0]; x <= b[0]; ++x) f(x, y, z);
        } else {
          if (home[0] - r >= 0) f(home[0] - r, y, z);
          if (home[0] + r < count[0]) f(home[0] + r, y, z);
        }
      }
  }
  std::size_t number(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(count[1]) + std::size_t(y)) * std::size_t(count[0]) + std::size_t(x);
  }
};

}  // namespace sinew
