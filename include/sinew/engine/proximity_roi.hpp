// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace sinew {

/// The N points nearest to the centres of some spheres, of those inside of one. Points come in the order of a
/// heap, the farthest first, as in SOFA.
template <class D>
struct ProximityROI {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(!D::rigid && D::size == 3, "ProximityROI selects points in space");
  static constexpr std::string_view className = "ProximityROI";

  std::vector<Eigen::Vector3d> centers{};
  std::vector<double> radii{};
  int N = 0;
  typename D::VecCoord position{};

  static constexpr auto fields() {
    using R = ProximityROI;
    return field_list(
        field("centers", &R::centers, "m", "centres of the spheres"),
        field("radii",
              &R::radii,
              "m",
              "of the spheres; the last is that of all further ones; where there is none, none are selected",
              range::nonNegative),
        field("N", &R::N, "", "points at most; none are selected where it is 0", range::nonNegative),
        field("position", &R::position, "m", "points to choose from").also("rest_position"));
  }

  // after update
  std::vector<int> indices{}, indicesOut{};
  typename D::VecCoord pointsInROI{};
  std::vector<double> distance{};

  static constexpr auto outputs() {
    using R = ProximityROI;
    return field_list(field("indices", &R::indices, "", "the points").also("pointIndices"),
                      field("indicesOut", &R::indicesOut, "", "the other points"),
                      field("pointsInROI", &R::pointsInROI, "m", "positions of the points"),
                      field("distance", &R::distance, "m", "of each to the nearest centre"));
  }

  void update(std::string_view where) {
    check_fields(*this, where);
    indices.clear(), indicesOut.clear(), pointsInROI.clear(), distance.clear();
    if (centers.empty() || radii.empty() || N == 0) return;
    std::vector<std::pair<double, int>> heap;
    const auto nearer = [](auto const& a, auto const& b) { return a.first < b.first; };
    for (std::size_t i = 0; i < position.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t s = 0; s < centers.size(); ++s) {
        const double d = (centers[s] - position[i].template cast<double>()).norm();
        if (d < radii[std::min(s, radii.size() - 1)]) least = std::min(least, d);
      }
      const bool full = heap.size() == std::size_t(N);
      if (std::isinf(least) || (full && heap.front().first < least)) {
        indicesOut.push_back(int(i));
        continue;
      }
      if (full) {
        std::pop_heap(heap.begin(), heap.end(), nearer);
        indicesOut.push_back(heap.back().second);
        heap.pop_back();
      }
      heap.emplace_back(least, int(i));
      std::push_heap(heap.begin(), heap.end(), nearer);
    }
    for (auto const& [d, i] : heap) {
      indices.push_back(i);
      distance.push_back(d);
      pointsInROI.push_back(position[std::size_t(i)]);
    }
  }
};

}  // namespace sinew
