// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/edge_sheets.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// The edges that are split where elements are refined: all of theirs, and with a side of a quad or a
/// hexahedron the sides opposite to it, and those opposite to these, which are a sheet (Murdoch, Benzley,
/// Blacker, Mitchell 1997). So a quad or a hexahedron is parted along some of its axes, from side to side.
class SplitEdges {
 public:
  /// Empty numbers: all. Throws Error where a number leads nowhere, and where an element would be parted that
  /// cannot be.
  SplitEdges(TopologyView const& body, std::span<Eigen::Vector3d const> rest, ElementNumbers const& elements);

  /// The longest at rest first.
  std::vector<Edge> const& inOrder() const { return order_; }
  /// Its place in this order, -1 for one that is not split.
  Index rank(Edge const& e) const {
    const auto found = rank_.find(e);
    return found == rank_.end() ? -1 : found->second;
  }
  /// The axes along which a quad or a hexahedron is parted, as bits.
  template <std::size_t N>
  int axes(std::array<Index, N> const& cell) const {
    int split = 0;
    for_each_cell_side(cell, [&](int axis, Edge const& e) {
      if (rank(e) >= 0) split |= 1 << axis;
    });
    return split;
  }

 private:
  std::vector<Edge> order_{};
  std::map<Edge, Index> rank_{};

  static std::vector<Edge> wanted(TopologyView const& body, ElementNumbers const& elements);
  void check(TopologyView const& body) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <tuple>

namespace sinew::detail {

[[noreturn]] inline void refuse_refinement(int kind, std::size_t number) {
  throw Error({},
              text(element_kind_name(kind),
                   ' ',
                   number,
                   " would be parted, and elements of its kind are not refined while a scene runs; refine "
                   "others, that have none of its edges, or the mesh before"));
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE std::vector<Edge> SplitEdges::wanted(TopologyView const& body, ElementNumbers const& elements) {
  const auto lists = elements.lists();
  const bool all = std::all_of(lists.begin(), lists.end(), [](auto const* l) { return l->empty(); });
  std::vector<Edge> edges;
  for_each_kind(body, [&](int kind, auto const& list) {
    auto take = [&](Index number) {
      if (number < 0 || std::size_t(number) >= list.size())
        throw Error({},
                    text("there is no ",
                         element_kind_name(kind),
                         ' ',
                         number,
                         " to refine: there are ",
                         list.size(),
                         ", numbered from 0"));
      if (!is_simplex(kind) && !is_cell(kind)) detail::refuse_refinement(kind, std::size_t(number));
      for_each_side(kind, list[std::size_t(number)], [&](Edge const& e) { edges.push_back(e); });
    };
    if (all)
      for (std::size_t i = 0; i < list.size(); ++i) take(Index(i));
    else
      for (const Index i : *lists[std::size_t(kind)]) take(i);
  });
  return edges;
}

SINEW_ONCE SplitEdges::SplitEdges(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                                  ElementNumbers const& elements) {
  auto squaredLength = [&](Edge const& e) {
    return (rest[std::size_t(e[1])] - rest[std::size_t(e[0])]).squaredNorm();
  };
  std::vector<std::tuple<double, Edge>> byLength;
  for (Edge const& e : EdgeSheets(body).whole(wanted(body, elements)))
    byLength.emplace_back(-squaredLength(e), e);
  std::sort(byLength.begin(), byLength.end());
  for (auto const& [length, e] : byLength) {
    rank_[e] = Index(order_.size());
    order_.push_back(e);
  }
  check(body);
}

// that what is parted can be, and no diagonal of a quad or a hexahedron is in the way
SINEW_ONCE void SplitEdges::check(TopologyView const& body) const {
  const bool beside = !body.edges.empty() || !body.triangles.empty() || !body.tetrahedra.empty();
  std::map<Edge, std::string> across;  // diagonals of what is parted
  for_each_kind(body, [&](int kind, auto const& list) {
    if (is_simplex(kind)) return;
    for (std::size_t e = 0; e < list.size(); ++e) {
      auto const& element = list[e];
      if (!is_cell(kind)) {
        for_each_pair(element, [&](Edge const& pair) {
          if (rank(pair) >= 0) detail::refuse_refinement(kind, e);
        });
      } else if constexpr (std::tuple_size_v<std::decay_t<decltype(element)>> == 4 ||
                           std::tuple_size_v<std::decay_t<decltype(element)>> == 8) {
        const int split = axes(element);
        auto name = [&] { return text(element_kind_name(kind), ' ', e); };
        auto points = element;
        std::sort(points.begin(), points.end());
        if (const auto twice = std::adjacent_find(points.begin(), points.end());
            split != 0 && twice != points.end())
          throw Error({}, text(name(), " would be parted, and has point ", *twice, " twice; correct it"));
        for (std::size_t i = 0; i < element.size(); ++i)
          for (std::size_t k = i + 1; k < element.size(); ++k) {
            const int between = axes_between(i, k);
            if (between == 1 || between == 2 || between == 4) continue;
            const Edge diagonal{std::min(element[i], element[k]), std::max(element[i], element[k])};
            if (rank(diagonal) >= 0)
              throw Error({},
                          text("edge ",
                               diagonal[0],
                               ' ',
                               diagonal[1],
                               " is a diagonal of ",
                               name(),
                               ", which has no point amid it; refine other elements than those with this "
                               "edge, or put them into a topology of their own"));
            if (beside && (between & split) != 0) across.emplace(diagonal, name());
          }
      }
    }
  });
  for_each_kind(body, [&](int kind, auto const& list) {
    if (!is_simplex(kind) || across.empty()) return;
    for (std::size_t e = 0; e < list.size(); ++e) {
      bool parted = false;
      auto lies = across.end();
      for_each_pair(list[e], [&](Edge const& pair) {
        parted = parted || rank(pair) >= 0;
        if (lies == across.end()) lies = across.find(pair);
      });
      if (!parted && lies != across.end())
        throw Error({},
                    text(element_kind_name(kind),
                         ' ',
                         e,
                         " lies across ",
                         lies->second,
                         ", which would be parted; put it into a topology of its own"));
    }
  });
}

}  // namespace sinew
#endif
