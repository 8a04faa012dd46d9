// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace sinew {

/// An order in which elimination of a symmetric sparse matrix fills in little: the unknown of the least
/// approximate degree is the next (Amestoy, Davis, Duff 1996). What an elimination joins is kept as one
/// element, the list of its unknowns, which swallows the elements it touches. rowStart, columns: the full
/// pattern in compressed rows, as of CompressedRowSparseMatrix. Returns old indices by new.
std::vector<int> minimum_degree_order(std::span<int const> rowStart, std::span<int const> columns);

/// The same elimination with children before and next to their parents: what is used together stands
/// together. parent: the elimination tree, -1 at its roots. Returns old indices by new.
std::vector<int> postorder(std::span<int const> parent);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cstddef>

namespace sinew {

SINEW_ONCE std::vector<int> minimum_degree_order(std::span<int const> rowStart,
                                                 std::span<int const> columns) {
  using Size = std::size_t;
  const int n = rowStart.empty() ? 0 : int(rowStart.size()) - 1;
  std::vector<std::vector<int>> unknowns{Size(n)}, elements{Size(n)};  // next to each unknown
  std::vector<std::vector<int>> members{Size(n)};            // of each element, numbered as its pivot
  std::vector<int> degree(Size(n), 0), outside(Size(n), 0);  // outside: |members less the new ones|
  std::vector<int> seen(Size(n), -1), counted(Size(n), -1);  // by which pivot, as member and as element
  std::vector<char> alive(Size(n), 0);                       // elements not swallowed

  // unknowns of equal degree in linked lists, the last one in is the first out
  std::vector<int> head(Size(n) + 1, -1), next(Size(n), -1), previous(Size(n), -1);
  auto insert = [&](int i) {
    int& first = head[Size(degree[Size(i)])];
    previous[Size(i)] = -1;
    next[Size(i)] = first;
    if (first >= 0) previous[Size(first)] = i;
    first = i;
  };
  auto remove = [&](int i) {
    const int before = previous[Size(i)], after = next[Size(i)];
    (before >= 0 ? next[Size(before)] : head[Size(degree[Size(i)])]) = after;
    if (after >= 0) previous[Size(after)] = before;
  };
  for (int i = n; i-- > 0;) {
    for (int k = rowStart[Size(i)]; k < rowStart[Size(i) + 1]; ++k)
      if (columns[Size(k)] != i) unknowns[Size(i)].push_back(columns[Size(k)]);
    degree[Size(i)] = int(unknowns[Size(i)].size());
    insert(i);
  }

  std::vector<int> order;
  order.reserve(Size(n));
  for (int minimum = 0; int(order.size()) < n;) {
    while (head[Size(minimum)] < 0) ++minimum;
    const int pivot = head[Size(minimum)];
    remove(pivot);
    order.push_back(pivot);

    // the new element: neighbours of the pivot, and members of its elements, which it swallows
    auto& fresh = members[Size(pivot)];
    auto join = [&](int i) {
      if (i == pivot || seen[Size(i)] == pivot) return;
      seen[Size(i)] = pivot;
      fresh.push_back(i);
    };
    for (const int i : unknowns[Size(pivot)]) join(i);
    for (const int e : elements[Size(pivot)])
      if (alive[Size(e)]) {
        for (const int i : members[Size(e)]) join(i);
        alive[Size(e)] = 0;
        members[Size(e)] = {};
      }
    unknowns[Size(pivot)] = elements[Size(pivot)] = {};
    alive[Size(pivot)] = 1;

    for (const int i : fresh)
      for (const int e : elements[Size(i)]) {
        if (!alive[Size(e)]) continue;
        if (counted[Size(e)] != pivot) outside[Size(e)] = int(members[Size(e)].size());
        counted[Size(e)] = pivot;
        --outside[Size(e)];
      }
    const int others = int(fresh.size()) - 1, left = n - int(order.size()) - 1;
    for (const int i : fresh) {
      remove(i);
      auto& neighbours = unknowns[Size(i)];
      neighbours.erase(std::remove_if(neighbours.begin(),
                                      neighbours.end(),
                                      [&](int j) { return j == pivot || seen[Size(j)] == pivot; }),
                       neighbours.end());
      int bound = int(neighbours.size()) + others;
      auto& parts = elements[Size(i)];
      parts.erase(
          std::remove_if(
              parts.begin(), parts.end(), [&](int e) { return !alive[Size(e)] || outside[Size(e)] == 0; }),
          parts.end());
      for (const int e : parts) bound += outside[Size(e)];
      parts.push_back(pivot);
      degree[Size(i)] = std::min({bound, degree[Size(i)] + others, left});
      insert(i);
      minimum = std::min(minimum, degree[Size(i)]);
    }
  }
  return order;
}

SINEW_ONCE std::vector<int> postorder(std::span<int const> parent) {
  const std::size_t n = parent.size();
  std::vector<int> child(n, -1), sibling(n, -1), order, path;
  for (std::size_t i = n; i-- > 0;)
    if (parent[i] >= 0) {
      sibling[i] = child[std::size_t(parent[i])];
      child[std::size_t(parent[i])] = int(i);
    }
  order.reserve(n);
  for (std::size_t root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    path.assign(1, int(root));
    while (!path.empty()) {
      const std::size_t i = std::size_t(path.back());
      if (child[i] >= 0) {
        path.push_back(child[i]);
        child[i] = sibling[std::size_t(child[i])];
      } else {
        order.push_back(int(i));
        path.pop_back();
      }
    }
  }
  return order;
}

}  // namespace sinew
#endif
