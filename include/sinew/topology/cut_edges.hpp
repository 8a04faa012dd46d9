// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/renumbering.hpp>
#include <sinew/topology/cut_pattern.hpp>
#include <sinew/topology/cut_rules.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>
#include <vector>

namespace sinew::detail {

/// Which elements a cut goes through, the points that it passes through, and the edges that it splits: steps
/// 1 to 3 of plan_cut, for triangles (N = 3) and tetrahedra.
template <std::size_t N>
class CutEdges {
 public:
  using Element = std::array<Index, N>;

  CutEdges(std::vector<Eigen::Vector3d> const& x, std::span<Element const> list, CutFront const& crossed,
           CutRules const& rules)
      : rest(x), elements(list), rules_(rules), crossings(crossed.crossings) {
    inFront.assign(rest.size(), 0);
    for (const Index i : crossed.points) inFront[std::size_t(i)] = 1;
    std::stable_sort(crossings.begin(), crossings.end(), before);
    crossings.erase(std::unique(crossings.begin(), crossings.end(), sameEdge), crossings.end());
    used.assign(crossings.size(), 0);
    on = inFront;
    setSides(crossed.sides);
    findWhole();
    if (whole == 0) return;
    snap();
    split();
  }

  std::vector<Eigen::Vector3d> const& rest;
  std::span<Element const> elements;

 private:
  CutRules const& rules_;

 public:
  std::vector<Crossing> crossings;
  std::vector<char> used{};            // of the crossings: by an element that is cut
  std::vector<char> inFront{};         // points in which an earlier cut ends
  std::vector<char> on{};              // points through which this one passes
  std::vector<CutFront::Side> side{};  // of points: by the last stroke that says
  std::size_t whole = 0;               // how many elements are cut
  std::vector<char> isWhole{};         // which
  std::vector<EdgeSplit> splits{};
  std::vector<Origin> origins{};  // of their middles
  std::vector<char> isSplit{};    // elements that have parts

  static bool before(Crossing const& p, Crossing const& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }
  static bool sameEdge(Crossing const& p, Crossing const& q) { return p.a == q.a && p.b == q.b; }
  int crossingOf(Index i, Index j) const {
    const Crossing edge{std::min(i, j), std::max(i, j), 0};
    const auto found = std::lower_bound(crossings.begin(), crossings.end(), edge, before);
    return found != crossings.end() && sameEdge(*found, edge) ? int(found - crossings.begin()) : -1;
  }
  bool isSplitEdge(std::size_t crossing) const { return numbers_[crossing] >= 0; }
  /// The splits of the edges of an element, in their order.
  template <std::size_t M>
  std::vector<EdgeSplit> splitsOf(std::array<Index, M> const& element) const {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < M; ++i)
      for (std::size_t j = i + 1; j < M; ++j)
        if (const int c = crossingOf(element[i], element[j]); c >= 0 && numbers_[std::size_t(c)] >= 0)
          numbers.push_back(numbers_[std::size_t(c)]);
    std::sort(numbers.begin(), numbers.end());
    std::vector<EdgeSplit> here;
    for (const int k : numbers) here.push_back(splits[std::size_t(k)]);
    return here;
  }

 private:
  std::vector<int> numbers_{};  // of crossings that are split among splits

  std::array<Eigen::Vector3d, N> at(Element const& e) const {
    std::array<Eigen::Vector3d, N> x;
    for (std::size_t k = 0; k < N; ++k) x[k] = place(e[k]);
    return x;
  }
  Eigen::Vector3d place(Index i) const {
    if (std::size_t(i) < rest.size()) return rest[std::size_t(i)];
    Origin const& o = origins[std::size_t(i) - rest.size()];
    return value_between(rest[std::size_t(o.a)], rest[std::size_t(o.b)], o.weight);
  }

  void setSides(std::vector<CutFront::Side> const& known) {
    side.assign(rest.size(), {-1, 0, -1});
    auto set = [this](Index i, int of, int stroke) {
      if (stroke > side[std::size_t(i)].stroke) side[std::size_t(i)] = {i, of, stroke};
    };
    for (auto const& k : known) set(k.point, k.side, k.stroke);
    for (Crossing const& c : crossings) set(c.a, c.side, c.stroke), set(c.b, -c.side, c.stroke);
  }

  // 1. elements through which the blade has gone: by all that it has crossed, or by its last stroke alone,
  // with as few as possible of the points in which a cut ended
  void findWhole() {
    isWhole.assign(elements.size(), 0);
    std::vector<char> touched(rest.size(), 0);
    for (Crossing const& c : crossings) touched[std::size_t(c.a)] = touched[std::size_t(c.b)] = 1;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      Element const& element = elements[e];
      int ends = 0;
      for (const Index i : element) ends += touched[std::size_t(i)];
      if (ends < 2) continue;
      int number[N][N], last = -1, any = -1;
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = i + 1; j < N; ++j) {
          const int c = number[i][j] = number[j][i] = crossingOf(element[i], element[j]);
          any = std::max(any, c);
          if (c >= 0) last = std::max(last, crossings[std::size_t(c)].stroke);
        }
      if (any < 0) continue;
      unsigned front = 0;
      for (std::size_t i = 0; i < N; ++i) front |= unsigned(inFront[std::size_t(element[i])] != 0) << i;
      for (const bool lastOnly : {false, true})
        for (int inCut = 0; inCut <= int(N) - 2; ++inCut)
          for (unsigned points = 0; points <= front; ++points) {
            if (isWhole[e] || (points & ~front) != 0 || std::popcount(points) != inCut) continue;
            const auto sides = SidesOfSimplex<N>::of(
                [&](std::size_t i, std::size_t j) {
                  const int c = number[i][j];
                  return c >= 0 && (!lastOnly || crossings[std::size_t(c)].stroke == last);
                },
                points);
            if (sides.whole) goThrough(e, sides, number);
          }
    }
  }
  void goThrough(std::size_t e, SidesOfSimplex<N> const& sides, int const (&number)[N][N]) {
    isWhole[e] = 1;
    ++whole;
    for (std::size_t i = 0; i < N; ++i) {
      if (sides.side[i] == 0) on[std::size_t(elements[e][i])] = 1;
      for (std::size_t j = i + 1; j < N; ++j)
        if (sides.side[i] * sides.side[j] < 0) used[std::size_t(number[i][j])] = 1;
    }
  }

  // 2. points through which the cut passes; one in which a cut ended stays a point of it
  void snap() {
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      if (!used[c]) continue;
      Crossing const& edge = crossings[c];
      if (edge.weight <= rules_.snapping || inFront[std::size_t(edge.a)]) on[std::size_t(edge.a)] = 1;
      if (edge.weight >= 1 - rules_.snapping || inFront[std::size_t(edge.b)]) on[std::size_t(edge.b)] = 1;
    }
  }

  // 3. edges that are split, the longest first; points that make bad elements are passed through instead
  void split() {
    std::vector<Element> parts;
    for (bool good = false; !good;) {
      good = true;
      collectSplits();
      std::vector<char> ends(rest.size(), 0);
      for (EdgeSplit const& s : splits) ends[std::size_t(s.a)] = ends[std::size_t(s.b)] = 1;
      isSplit.assign(elements.size(), 0);
      for (std::size_t e = 0; e < elements.size(); ++e) {
        int count = 0;
        for (const Index i : elements[e]) count += ends[std::size_t(i)];
        if (count < 2) continue;
        const std::vector<EdgeSplit> here = splitsOf(elements[e]);
        if (here.empty()) continue;
        isSplit[e] = 1;
        split_simplex<N>(elements[e], here, parts);
        const double bound = std::min(rules_.quality, simplex_quality(at(elements[e]))) * (1 - 1e-12);
        if (std::all_of(parts.begin(), parts.end(), [&](Element const& part) {
              return simplex_quality(at(part)) >= bound;
            }))
          continue;
        good = false;
        passThroughNearest(here);
      }
    }
  }
  void collectSplits() {
    splits.clear();
    origins.clear();
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      Crossing const& edge = crossings[c];
      if (!used[c] || on[std::size_t(edge.a)] || on[std::size_t(edge.b)]) continue;
      order.emplace_back(-(rest[std::size_t(edge.b)] - rest[std::size_t(edge.a)]).squaredNorm(), c);
    }
    std::sort(order.begin(), order.end());
    for (auto const& [length, c] : order) {
      Crossing const& edge = crossings[c];
      splits.push_back({edge.a, edge.b, Index(rest.size() + origins.size())});
      origins.push_back({edge.a, edge.b, edge.weight});
    }
    numbers_.assign(crossings.size(), -1);
    for (std::size_t k = 0; k < order.size(); ++k) numbers_[order[k].second] = int(k);
  }
  void passThroughNearest(std::vector<EdgeSplit> const& here) {
    double nearest = 2;
    Index point = -1;
    for (EdgeSplit const& s : here) {
      const double weight = origins[std::size_t(s.middle) - rest.size()].weight;
      if (weight < nearest) nearest = weight, point = s.a;
      if (1 - weight < nearest) nearest = 1 - weight, point = s.b;
    }
    on[std::size_t(point)] = 1;
  }
};

}  // namespace sinew::detail
