// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace sinew {

/// Which aggregate each point of a graph belongs to, -1: none, and how many there are.
struct Aggregates {
  std::vector<int> of{};
  int count = 0;
};

/// Points in aggregates of about one neighbourhood each (Vanek, Mandel, Brezina 1996, algorithm 5.1): first
/// whole neighbourhoods of points none of whose neighbours is in an aggregate, in the order of points; then
/// what is left joins the aggregate of the first pass to which it is joined most strongly; then neighbours
/// among the rest join each other. Points without neighbours are in none. start, neighbours: the graph in
/// compressed rows without its diagonal, with the strength of each connection. found: aggregates that are
/// there already; others come beside them.
Aggregates aggregate_points(std::span<int const> start, std::span<int const> neighbours,
                            std::span<float const> strength, Aggregates found = {});

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE Aggregates aggregate_points(std::span<int const> start, std::span<int const> neighbours,
                                       std::span<float const> strength, Aggregates found) {
  const std::size_t n = start.empty() ? 0 : start.size() - 1;
  found.of.resize(n, -1);
  auto each = [&](std::size_t i, auto&& f) {
    for (int k = start[i]; k < start[i + 1]; ++k)
      f(std::size_t(neighbours[std::size_t(k)]), strength[std::size_t(k)]);
  };
  auto together = [&](std::size_t i) {
    const int own = found.count++;
    found.of[i] = own;
    each(i, [&](std::size_t j, float) {
      if (found.of[j] < 0) found.of[j] = own;
    });
  };
  for (std::size_t i = 0; i < n; ++i) {
    bool free = found.of[i] < 0 && start[i] < start[i + 1];
    each(i, [&](std::size_t j, float) { free = free && found.of[j] < 0; });
    if (free) together(i);
  }
  const std::vector<int> first = found.of;
  for (std::size_t i = 0; i < n; ++i) {
    if (found.of[i] >= 0) continue;
    float most = 0;
    each(i, [&](std::size_t j, float s) {
      if (first[j] >= 0 && s > most) most = s, found.of[i] = first[j];
    });
  }
  for (std::size_t i = 0; i < n; ++i)
    if (found.of[i] < 0 && start[i] < start[i + 1]) together(i);
  return found;
}

}  // namespace sinew
#endif
