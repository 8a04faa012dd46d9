// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/cut_rules.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sinew {

/// A blade that moves through a body.
struct BladeStroke {
  SweptBlade blade;
  int number = 0;       // from where the blade went in on
  bool turned = false;  // its front is where its back was when the stroke began
};

/// Adds to a front the edges of elements that a blade crosses. Points of the body are at x, and were `before`
/// when the blade started (empty: there too): of each edge the motion of its middle counts. An edge that the
/// same stroke has crossed already stays as it is.
template <std::size_t N>
void add_crossings(std::span<std::array<Index, N> const> elements, std::vector<Eigen::Vector3d> const& x,
                   std::vector<Eigen::Vector3d> const& before, BladeStroke const& stroke, CutFront& front) {
  auto shift = [&](Index i) -> Eigen::Vector3d {
    if (before.empty()) return Eigen::Vector3d::Zero();
    return x[std::size_t(i)] - before[std::size_t(i)];
  };
  double furthest = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    furthest = std::max(furthest, shift(Index(i)).squaredNorm());
  Eigen::AlignedBox3d reach = stroke.blade.box();
  const Eigen::Vector3d margin =
      Eigen::Vector3d::Constant(std::sqrt(furthest) + 1e-9 * reach.diagonal().norm());
  reach = {reach.min() - margin, reach.max() + margin};

  std::vector<Edge> edges;
  for (auto const& e : elements) {
    Eigen::AlignedBox3d box;
    for (const Index i : e) box.extend(x[std::size_t(i)]);
    if (!reach.intersects(box)) continue;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = i + 1; j < N; ++j) edges.push_back({std::min(e[i], e[j]), std::max(e[i], e[j])});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  auto less = [](Crossing const& p, Crossing const& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  std::sort(front.crossings.begin(), front.crossings.end(), less);
  const std::size_t known = front.crossings.size();
  for (Edge const& e : edges) {
    auto const& x0 = x[std::size_t(e[0])];
    auto const& x1 = x[std::size_t(e[1])];
    const auto hit = stroke.blade.crossing(x0, x1, (shift(e[0]) + shift(e[1])) / 2);
    if (!hit) continue;
    const Crossing crossing{e[0], e[1], hit->weight, stroke.turned ? -hit->side : hit->side, stroke.number};
    const auto end = front.crossings.begin() + std::ptrdiff_t(known);
    const auto place = std::lower_bound(front.crossings.begin(), end, crossing, less);
    if (place == end || less(crossing, *place))
      front.crossings.push_back(crossing);
    else if (place->stroke < stroke.number)
      *place = crossing;
  }
}

}  // namespace sinew
