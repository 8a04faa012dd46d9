// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace sinew::detail {

/// Points to go on from, by their distance from a centre and their number.
using EdgeFront = std::set<std::pair<double, std::size_t>>;

/// Gives the points that are nearer along edges to those of `front`, whose `distance` and `cell` are set, the
/// cell of these (Dijkstra 1959); `around` has the neighbours of each point.
template <class Around, class Cell>
void spread_cells(EdgeFront front, std::span<Eigen::Vector3d const> position, Around const& around,
                  std::vector<double>& distance, std::vector<Cell>& cell) {
  while (!front.empty()) {
    const std::size_t from = front.begin()->second;
    front.erase(front.begin());
    for (const std::size_t to : around[from]) {
      const double d = distance[from] + (position[from] - position[to]).norm();
      if (!(distance[to] > d)) continue;
      front.erase({distance[to], to});
      cell[to] = cell[from], distance[to] = d;
      front.insert({d, to});
    }
  }
}

}  // namespace sinew::detail
