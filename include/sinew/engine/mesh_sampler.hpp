// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Some points spread evenly over others: the first point, then again and again the one farthest from all
/// chosen (Gonzalez 1985), after which each moves to the point of its cell nearest to the mean of the cell
/// (Lloyd 1982), until none moves. Distances are along the edges, where there are some, else straight.
struct MeshSampler {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshSampler";

  int number = 1;
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  int maxIter = 100;

  static constexpr auto fields() {
    using M = MeshSampler;
    return field_list(field("number", &M::number, "", "points that are chosen", range::atLeast(1)),
                      field("position", &M::position, "m", "points to choose from"),
                      field("edges", &M::edges, "", "along which distances are", range::nonNegative),
                      field("maxIter", &M::maxIter, "", "moves of all points at most", range::nonNegative));
  }

  // after update
  std::vector<int> outputIndices{};
  std::vector<Eigen::Vector3d> outputPosition{};

  static constexpr auto outputs() {
    using M = MeshSampler;
    return field_list(field("outputIndices", &M::outputIndices, "", "the points"),
                      field("outputPosition", &M::outputPosition, "m", "where they are"));
  }

  /// Throws Error where there is no point, or an edge refers to a missing one; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/cells_along_edges.hpp>

#include <limits>
#include <utility>

namespace sinew {

SINEW_ONCE void MeshSampler::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = position.size();
  if (n == 0) throw Error(at, "position is empty; link it to the points of a loader or topology");
  detail::check_indices(at, "edge", edges, n);
  std::vector<std::vector<std::size_t>> around(edges.empty() ? 0 : n);
  for (auto const& [a, b] : edges) {
    around[std::size_t(a)].push_back(std::size_t(b));
    around[std::size_t(b)].push_back(std::size_t(a));
  }
  std::vector<std::size_t> chosen{0}, cell(n, 0);  // the nearest chosen point of each
  std::vector<double> distance(n);                 // to it, or its square where that is straight
  auto measure = [&] {
    distance.assign(n, std::numeric_limits<double>::max());
    if (edges.empty()) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < chosen.size(); ++c)
          if (const double d = (position[i] - position[chosen[c]]).squaredNorm(); d < distance[i])
            distance[i] = d, cell[i] = c;
      return;
    }
    detail::EdgeFront front;
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      front.insert({0, chosen[c]});
      distance[chosen[c]] = 0, cell[chosen[c]] = c;
    }
    detail::spread_cells(std::move(front), position, around, distance, cell);
  };
  measure();
  while (chosen.size() < std::min(n, std::size_t(number))) {
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (distance[i] > distance[farthest]) farthest = i;
    if (!(distance[farthest] > 0)) break;
    chosen.push_back(farthest);
    measure();
  }
  bool moved = true;
  for (int iteration = 0; moved && iteration < maxIter; ++iteration) {
    std::vector<Eigen::Vector3d> mean(chosen.size(), Eigen::Vector3d::Zero());
    std::vector<double> count(chosen.size()), least;
    for (std::size_t i = 0; i < n; ++i) mean[cell[i]] += position[i], ++count[cell[i]];
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      mean[c] /= count[c];
      least.push_back((position[chosen[c]] - mean[cell[chosen[c]]]).squaredNorm());
    }
    moved = false;
    for (std::size_t i = 0; i < n; ++i)
      if (const double d = (position[i] - mean[cell[i]]).squaredNorm(); d < least[cell[i]])
        least[cell[i]] = d, chosen[cell[i]] = i, moved = true;
    measure();
  }
  outputIndices.clear(), outputPosition.clear();
  for (const std::size_t i : chosen) {
    outputIndices.push_back(int(i));
    outputPosition.push_back(position[i]);
  }
}

}  // namespace sinew
#endif
