// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/bounding_tree.hpp>
#include <sinew/core/compiled.hpp>

#include <compare>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

/// Two boxes, by their numbers.
struct BoxPair {
  int first, second;
  auto operator<=>(BoxPair const&) const = default;
};

/// Sorts pairs by their first, then their second number, in time proportional to pairs and numbers; keeps its
/// memory.
class PairSorter {
 public:
  /// The numbers are from 0 to below `numberOfFirst` and `numberOfSecond`.
  void sort(std::vector<BoxPair>& pairs, std::size_t numberOfFirst, std::size_t numberOfSecond);

 private:
  std::vector<BoxPair> sorted{};
  std::vector<int> start{};

  // stable, by one of the numbers
  void pass(std::vector<BoxPair> const& from, std::vector<BoxPair>& to, std::size_t n, int BoxPair::*key);
};

/// All pairs i < j whose boxes are within `margin` of each other along every axis, sorted, by comparing all
/// with all: the reference.
template <class Boxes, class Real>
std::vector<BoxPair> all_pairs(Boxes const& boxes, Real margin) {
  std::vector<BoxPair> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (!boxes[i].empty() && !boxes[j].empty() && boxes[i].overlaps(boxes[j], margin))
        pairs.push_back({int(i), int(j)});
  return pairs;
}

/// Which bodies may touch, from their boxes: the part of a collision pipeline that is called broad phase.
/// Bodies may come, go and jump; one with an empty box is absent.
///
/// A tree over the bodies, refitted from step to step. Against sweep and prune, along the axis of largest
/// extent and with eight comparisons at a time (AVX-512), its speed was 0.8, 1.2 and 3.3 times for 1,000,
/// 10,000 and 100,000 balls in a cube, 0.8, 0.8 and 1.2 times on a plane, and 0.4 times for balls in a row.
/// It has no arrangement that is bad for it, and does not need such registers.
template <class Real>
class BasicBroadPhase {
 public:
  using Box = BasicAxisBox<Real>;

  BasicBoundingTree<Real> tree{};

  /// All pairs i < j whose boxes are within `margin` of each other along every axis, sorted, each once; valid
  /// until the next call. Throws Error when a box is neither finite nor empty. Allocates when there are more
  /// boxes or pairs than ever before.
  std::span<BoxPair const> pairs(std::span<Box const> boxes, Real margin,
                                 std::string_view where = "BroadPhase") {
    tree.update(boxes, where);
    found.clear();
    tree.self_pairs(margin, [&](int i, int j) { found.push_back({i, j}); });
    sorter.sort(found, boxes.size(), boxes.size());
    return found;
  }

 private:
  std::vector<BoxPair> found{};
  PairSorter sorter{};
};

using BroadPhase = BasicBroadPhase<double>;

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <numeric>

namespace sinew {

SINEW_ONCE void PairSorter::sort(std::vector<BoxPair>& pairs, std::size_t numberOfFirst,
                                 std::size_t numberOfSecond) {
  if (pairs.size() < (numberOfFirst + numberOfSecond) / 16) return std::sort(pairs.begin(), pairs.end());
  sorted.resize(pairs.size());
  pass(pairs, sorted, numberOfSecond, &BoxPair::second);
  pass(sorted, pairs, numberOfFirst, &BoxPair::first);
}

SINEW_ONCE void PairSorter::pass(std::vector<BoxPair> const& from, std::vector<BoxPair>& to, std::size_t n,
                                 int BoxPair::*key) {
  start.assign(n + 1, 0);
  for (BoxPair const& p : from) ++start[std::size_t(p.*key) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (BoxPair const& p : from) to[std::size_t(start[std::size_t(p.*key)]++)] = p;
}

}  // namespace sinew
#endif
