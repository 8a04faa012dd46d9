// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/linalg/aggregation.hpp>

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Points that stand on a regular grid along the axes of space, as those of a body in an embedded grid do.
struct Lattice {
  std::vector<std::array<int, 3>> of{};  // of each point its place, from 0; empty: they stand on none
  std::array<int, 3> size{};             // places in each direction
};

/// The grid of those places that are finite: in each direction their numbers are evenly spaced, to a
/// thousandth of the spacing. Others have the place -1, -1, -1.
Lattice find_lattice(std::span<Eigen::Vector3d const> places);

/// The points of a lattice in cells of about three in each direction.
struct LatticeCells {
  Aggregates aggregates{};  // none (count 0): the grid does not suit the graph
  Lattice lattice{};        // of the cells
};

/// Points that have neighbours in the graph are put together by cells; cells of fewer than four points, which
/// could not turn, are left to others (-1). Where the points of a cell are not joined to each other within
/// it, as by a slit or where stiffness jumps, there are none. start, neighbours: as of aggregate_points().
LatticeCells aggregate_cells(Lattice const& lattice, std::span<int const> start,
                             std::span<int const> neighbours);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE Lattice find_lattice(std::span<Eigen::Vector3d const> places) {
  Lattice found;
  std::vector<double> values;
  std::array<double, 3> first{}, spacing{1, 1, 1};
  for (int c = 0; c < 3; ++c) {
    values.clear();
    for (auto const& x : places)
      if (x.allFinite()) values.push_back(x[c]);
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const double extent = values.back() - values.front();
    std::size_t distinct = 1;
    for (std::size_t i = 1; i < values.size(); ++i)
      if (values[i] - values[i - 1] > 1e-6 * extent) ++distinct;
    first[std::size_t(c)] = values.front();
    if (distinct > 1) spacing[std::size_t(c)] = extent / double(distinct - 1);
    found.size[std::size_t(c)] = int(distinct);
  }
  found.of.assign(places.size(), {-1, -1, -1});
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].allFinite()) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double at = (places[i][int(c)] - first[c]) / spacing[c], whole = std::round(at);
      if (std::abs(at - whole) > 1e-3) return {};
      found.of[i][c] = int(whole);
    }
  }
  return found;
}

SINEW_ONCE LatticeCells aggregate_cells(Lattice const& lattice, std::span<int const> start,
                                        std::span<int const> neighbours) {
  const std::size_t n = lattice.of.size();
  if (n == 0 || start.size() != n + 1) return {};
  LatticeCells cells;
  std::size_t all = 1;
  for (std::size_t c = 0; c < 3; ++c) {
    cells.lattice.size[c] = std::max(1, (lattice.size[c] + 2) / 3);
    all *= std::size_t(cells.lattice.size[c]);
  }
  if (all > n) return {};

  // the cell of each point, and how many points each has
  std::vector<int> cell(n, -1), points(all, 0), number(all, -1);
  auto cellOf = [&](std::array<int, 3> place) {
    for (std::size_t c = 0; c < 3; ++c)
      place[c] = int(long(place[c]) * cells.lattice.size[c] / lattice.size[c]);
    return place;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (start[i] == start[i + 1]) continue;
    if (lattice.of[i][0] < 0) return {};
    const auto k = cellOf(lattice.of[i]);
    cell[i] = (k[2] * cells.lattice.size[1] + k[1]) * cells.lattice.size[0] + k[0];
    ++points[std::size_t(cell[i])];
  }

  // from the first point of each cell on to all that it is joined to within the cell
  Aggregates& found = cells.aggregates;
  found.of.assign(n, -1);
  std::vector<int> reached;
  for (std::size_t i = 0; i < n; ++i) {
    if (cell[i] < 0 || points[std::size_t(cell[i])] < 4 || found.of[i] >= 0) continue;
    int& own = number[std::size_t(cell[i])];
    if (own >= 0) return {};  // a second part
    own = found.count++;
    cells.lattice.of.push_back(cellOf(lattice.of[i]));
    reached.assign(1, int(i));
    found.of[i] = own;
    while (!reached.empty()) {
      const std::size_t j = std::size_t(reached.back());
      reached.pop_back();
      for (int s = start[j]; s < start[j + 1]; ++s)
        if (const int k = neighbours[std::size_t(s)];
            cell[std::size_t(k)] == cell[i] && found.of[std::size_t(k)] < 0) {
          found.of[std::size_t(k)] = own;
          reached.push_back(k);
        }
    }
  }
  return cells;
}

}  // namespace sinew
#endif
