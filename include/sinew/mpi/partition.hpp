// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs METIS (Debian: libmetis-dev). CMake's target sinew::mpi brings it.
#include <sinew/core/context.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/renumbering.hpp>

#include <metis.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::mpi {

namespace detail {
/// f(points) for each element of some topologies over the same points.
template <class F>
void for_each_element(std::span<TopologyView const> topologies, F&& f) {
  for (TopologyView const& t : topologies)
    for_each_kind(t, [&](int, auto const& list) {
      for (auto const& element : list) f(element);
    });
}
}  // namespace detail

/// Lists of points that something joins as an element would.
using JoinedPoints = std::vector<std::vector<Index>>;

/// Shares out n points among so many ranks, with few elements between points of different ranks: METIS
/// (Karypis, Kumar 1998), on the graph of points that have an element in common, or are joined otherwise. The
/// same in each run. Throws Error where there are fewer points or elements than ranks; `mayHaveNone`: ranks
/// need no elements.
inline std::vector<int> parts_of_points(std::string_view where, std::size_t n,
                                        std::span<TopologyView const> topologies, int ranks,
                                        JoinedPoints const& together = {}, bool mayHaveNone = false) {
  std::size_t elements = together.size();
  detail::for_each_element(topologies, [&](auto const&) { ++elements; });
  if (n < std::size_t(ranks) || (elements < std::size_t(ranks) && !mayHaveNone))
    throw Error(where,
                text(n,
                     " points with ",
                     elements,
                     " elements cannot be shared out among ",
                     ranks,
                     " ranks; take fewer ranks (mpirun -n)"));
  if (ranks == 1) return std::vector<int>(n, 0);
  std::vector<std::vector<idx_t>> joined(n);
  auto join = [&](auto const& element) {
    for (const Index i : element)
      for (const Index j : element)
        if (i != j) joined[std::size_t(i)].push_back(idx_t(j));
  };
  detail::for_each_element(topologies, join);
  for (auto const& points : together) join(points);
  std::vector<idx_t> starts{0}, neighbours;
  for (auto& all : joined) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    neighbours.insert(neighbours.end(), all.begin(), all.end());
    starts.push_back(idx_t(neighbours.size()));
    all = {};
  }
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  idx_t points = idx_t(n), constraints = 1, parts = ranks, cut = 0;
  std::vector<idx_t> part(n, 0);
  const auto divide = ranks <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int code = divide(&points,
                          &constraints,
                          starts.data(),
                          neighbours.data(),
                          nullptr,
                          nullptr,
                          nullptr,
                          &parts,
                          nullptr,
                          nullptr,
                          options.data(),
                          &cut,
                          part.data());
  if (code != METIS_OK)
    throw Error(where,
                text("METIS has not shared out ",
                     n,
                     " points among ",
                     ranks,
                     " ranks (",
                     code == METIS_ERROR_MEMORY ? "out of memory" : "error in its input",
                     "); take fewer ranks"));
  return {part.begin(), part.end()};
}

/// What a rank has of the points of one state and of the elements over them: its own points, in the order of
/// the scene; elements with one of these at least, first those between its own points alone; and behind its
/// own points the others of these elements, the ghosts, owner by owner. So forces on its own points are
/// complete, from ghosts that are where their owners have them.
struct Part {
  std::vector<int> parts{};            // rank of each point of the scene
  std::vector<std::size_t> ownedBy{};  // how many points each rank has
  Renumbering points{};
  std::vector<TopologyChange> topologies{};
  std::vector<int> ghostOwner{}, ghostNumber{};  // of each ghost: its rank, and its number there
  /// By rank, in rising order: which own points are ghosts there.
  std::map<int, std::vector<int>> sent{};

  std::size_t owned(int rank) const { return ownedBy[std::size_t(rank)]; }
};

/// A point that a rank has, as a ghost where it is not its own; rank -1: each of them.
struct NeededPoint {
  Index point;
  int rank = -1;
};

/// `needed`: points that ranks have beside those of their elements. `mayHaveNone`: ranks need no elements.
inline Part part_of(std::string_view where, std::vector<int> parts, std::span<TopologyView const> topologies,
                    int rank, int ranks, JoinedPoints const& together = {},
                    std::span<NeededPoint const> needed = {}, bool mayHaveNone = false) {
  Part part;
  const std::size_t n = parts.size();
  part.ownedBy.assign(std::size_t(ranks), 0);
  std::vector<int> number(n);  // among the points of its owner
  std::vector<Index> kept;
  for (std::size_t i = 0; i < n; ++i) {
    number[i] = int(part.ownedBy[std::size_t(parts[i])]++);
    if (parts[i] == rank) kept.push_back(Index(i));
  }
  std::vector<bool> elementsOf(std::size_t(ranks), false), ghost(n, false);
  std::vector<std::pair<int, int>> sends;  // to a rank, a point
  auto take = [&](auto const& element) {
    bool here = false;
    for (const Index i : element) {
      elementsOf[std::size_t(parts[std::size_t(i)])] = true;
      here = here || parts[std::size_t(i)] == rank;
    }
    if (!here) return;
    for (const Index i : element) {
      const int owner = parts[std::size_t(i)];
      if (owner == rank) continue;
      ghost[std::size_t(i)] = true;
      for (const Index j : element)
        if (parts[std::size_t(j)] == rank) sends.emplace_back(owner, number[std::size_t(j)]);
    }
  };
  detail::for_each_element(topologies, take);
  for (auto const& points : together) take(points);
  // (who receives need not send: a rank without a point that others have is in their lists all the same)
  for (auto const& [i, by] : needed) {
    const int owner = parts[std::size_t(i)];
    if (owner != rank) {
      if (by >= 0 && by != rank) continue;
      ghost[std::size_t(i)] = true;
      part.sent[owner];
    } else {
      for (int r = by < 0 ? 0 : by; r < (by < 0 ? ranks : by + 1); ++r)
        if (r != rank) sends.emplace_back(r, number[std::size_t(i)]);
    }
  }
  for (int r = 0; r < ranks && !mayHaveNone; ++r)
    if (!elementsOf[std::size_t(r)])
      throw Error(where,
                  text("rank ",
                       r,
                       " of ",
                       ranks,
                       " would have no element of the ",
                       n,
                       " points; take fewer ranks (mpirun -n)"));
  std::sort(sends.begin(), sends.end());
  sends.erase(std::unique(sends.begin(), sends.end()), sends.end());
  for (auto const& [to, point] : sends) part.sent[to].push_back(point);
  std::vector<Index> ghosts;
  for (std::size_t i = 0; i < n; ++i)
    if (ghost[i]) ghosts.push_back(Index(i));
  std::stable_sort(ghosts.begin(), ghosts.end(), [&](Index i, Index j) {
    return parts[std::size_t(i)] < parts[std::size_t(j)];
  });
  for (const Index i : ghosts) {
    part.ghostOwner.push_back(parts[std::size_t(i)]);
    part.ghostNumber.push_back(number[std::size_t(i)]);
  }
  kept.insert(kept.end(), ghosts.begin(), ghosts.end());
  part.points = Renumbering::inOrder(std::move(kept), n);
  for (TopologyView const& t : topologies) {
    TopologyChange& change = part.topologies.emplace_back();
    change.points = part.points;
    for_each_kind(t, [&](int kind, auto const& list) {
      std::vector<Index> inner, border;
      for (std::size_t e = 0; e < list.size(); ++e) {
        bool any = false, all = true;
        for (const Index i : list[e]) {
          const bool own = parts[std::size_t(i)] == rank;
          any = any || own;
          all = all && own;
        }
        if (any) (all ? inner : border).push_back(Index(e));
      }
      inner.insert(inner.end(), border.begin(), border.end());
      change.elements[std::size_t(kind)] = Renumbering::inOrder(std::move(inner), list.size());
    });
  }
  part.parts = std::move(parts);
  return part;
}

}  // namespace sinew::mpi
