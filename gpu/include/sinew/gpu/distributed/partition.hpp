// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// A part of a body: points of its own, and its halo, those of other parts with which its own share an
/// element. It has all elements of its own points, so that what acts on these is found by the part alone
/// where it knows its halo.
struct BodyPart {
  /// Of the body: `inner` points that no halo has, then up to `own` those that some have, then the halo; each
  /// in rising order.
  std::vector<int> points{};
  int inner = 0, own = 0;
  /// For points from `inner` to `own`: the halos that have them, and where.
  struct Place {
    int part, point;
  };
  std::vector<int> first{0};
  std::vector<Place> places{};
};

/// A body cut into parts with as many points each, by planes across its longest extents (recursive bisection
/// by coordinates; Berger, Bokhari 1987).
class BodyPartition {
 public:
  std::vector<BodyPart> parts{};
  std::vector<int> partOf{};  // of each point

  /// eachElement(f): f(points) for the elements of all force fields. Throws Error where there are fewer
  /// points than parts.
  template <class EachElement>
  BodyPartition(std::vector<Eigen::Vector3d> const& places, std::size_t count, EachElement&& eachElement)
      : parts(count), partOf(places.size(), 0) {
    if (places.size() < count)
      throw Error("DistributedSimulation",
                  text("a body of ", places.size(), " points is to be on ", count, " devices; take fewer"));
    std::vector<int> order(places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = int(i);
    bisect(places, order, 0, order.size(), 0, count);

    std::vector<std::vector<int>> halo(count);
    std::vector<unsigned char> bordering(places.size(), 0);
    eachElement([&](auto const& points) {
      bool one = true;
      for (const int i : points) one = one && part(i) == part(points[0]);
      if (one) return;
      for (const int i : points)
        for (const int j : points)
          if (part(i) != part(j)) {
            halo[part(j)].push_back(i);
            bordering[std::size_t(i)] = 1;
          }
    });
    for (const int borders : {0, 1})
      for (std::size_t i = 0; i < places.size(); ++i)
        if (bordering[i] == borders) {
          BodyPart& p = parts[std::size_t(partOf[i])];
          p.points.push_back(int(i));
          p.inner += 1 - borders;
          ++p.own;
        }
    std::vector<std::vector<std::pair<int, BodyPart::Place>>> seen(count);
    for (std::size_t p = 0; p < count; ++p) {
      auto& own = halo[p];
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      for (const int i : own) {
        seen[part(i)].push_back({i, {int(p), int(parts[p].points.size())}});
        parts[p].points.push_back(i);
      }
    }
    for (std::size_t p = 0; p < count; ++p) {
      std::stable_sort(
          seen[p].begin(), seen[p].end(), [](auto const& a, auto const& b) { return a.first < b.first; });
      for (std::size_t k = 0; k < seen[p].size(); ++k) {
        parts[p].places.push_back(seen[p][k].second);
        if (k + 1 == seen[p].size() || seen[p][k + 1].first != seen[p][k].first)
          parts[p].first.push_back(int(k) + 1);
      }
    }
  }

  std::size_t part(int point) const { return std::size_t(partOf[std::size_t(point)]); }

 private:
  // points order[begin .. end) are shared out among parts from `first` on
  void bisect(std::vector<Eigen::Vector3d> const& places, std::vector<int>& order, std::size_t begin,
              std::size_t end, std::size_t first, std::size_t count) {
    if (count == 1) {
      for (std::size_t k = begin; k < end; ++k) partOf[std::size_t(order[k])] = int(first);
      return;
    }
    Eigen::Vector3d low = places[std::size_t(order[begin])], high = low;
    for (std::size_t k = begin; k < end; ++k) {
      low = low.cwiseMin(places[std::size_t(order[k])]);
      high = high.cwiseMax(places[std::size_t(order[k])]);
    }
    // of axes alike the last, along which the numbers of grids rise slowest
    int axis = 2;
    for (const int c : {1, 0})
      if (high[c] - low[c] > (1 + 1e-9) * (high[axis] - low[axis])) axis = c;
    const std::size_t lower = count / 2, middle = begin + (end - begin) * lower / count;
    std::nth_element(order.begin() + std::ptrdiff_t(begin),
                     order.begin() + std::ptrdiff_t(middle),
                     order.begin() + std::ptrdiff_t(end),
                     [&](int a, int b) {
                       const double x = places[std::size_t(a)][axis], y = places[std::size_t(b)][axis];
                       return x != y ? x < y : a < b;
                     });
    bisect(places, order, begin, middle, first, lower);
    bisect(places, order, middle, end, first + lower, count - lower);
  }
};

}  // namespace sinew::gpu
