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
/// Blacker, Mitchell 1997). So a quad or a hexahedron is parted along some of its axes, from side to side. An
/// edge, triangle or tetrahedron may have a diagonal of a quad or of a face of a hexahedron, as halves of
/// quads have: one of a face that is parted along both axes is split at the point amid the face, and where a
/// diagonal is split, its face is.
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
  /// The faces amid which the split edges that are diagonals are split.
  std::map<Edge, Quad> const& diagonals() const { return diagonals_; }
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
  std::map<Edge, Quad> diagonals_{};

  static std::vector<Edge> wanted(TopologyView const& body, ElementNumbers const& elements);
  std::vector<Edge> split(TopologyView const& body, std::vector<Edge> edges);
  void check(TopologyView const& body) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>

#include <set>
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

// all of their sheets, and diagonals
SINEW_ONCE std::vector<Edge> SplitEdges::split(TopologyView const& body, std::vector<Edge> edges) {
  EdgeSheets sheets(body);
  edges = sheets.whole(std::move(edges));
  std::set<Edge> beside;
  for_each_kind(body, [&](int kind, auto const& list) {
    if (is_simplex(kind) && !(body.quads.empty() && body.hexahedra.empty()))
      for (auto const& e : list) for_each_edge(e, [&](Edge const& pair) { beside.insert(pair); });
  });
  if (beside.empty()) return edges;
  auto isSplit = [&](Edge const& e) { return std::binary_search(edges.begin(), edges.end(), e); };
  auto between = [](Quad const& f, std::size_t a, std::size_t b) {
    return Edge{std::min(f[a], f[b]), std::max(f[a], f[b])};
  };
  for (bool more = true; more;) {
    more = false;
    std::vector<Edge> sides = edges;
    for_each_quad_face(body, [&](Quad const& f) {
      if (!isSplit(between(f, 0, 2)) && !isSplit(between(f, 1, 3))) return;
      for (std::size_t k = 0; k < 4; ++k)
        if (const Edge side = between(f, k, (k + 1) % 4); !isSplit(side)) sides.push_back(side), more = true;
    });
    if (more) edges = sheets.whole(std::move(sides));
  }
  for_each_quad_face(body, [&](Quad const& f) {
    if (!isSplit(between(f, 0, 1)) || !isSplit(between(f, 1, 2))) return;
    for (Edge const& diagonal : {between(f, 0, 2), between(f, 1, 3)}) {
      if (!beside.contains(diagonal)) continue;
      const auto [of, fresh] = diagonals_.emplace(diagonal, f);
      if (sheets.isSide(diagonal) || sorted_corners(of->second) != sorted_corners(f))
        throw Error({},
                    text("edge ",
                         diagonal[0],
                         ' ',
                         diagonal[1],
                         " is a diagonal of the face ",
                         f[0],
                         ' ',
                         f[1],
                         ' ',
                         f[2],
                         ' ',
                         f[3],
                         ", which would be parted, and a side or a diagonal of another one; refine elements "
                         "elsewhere, or correct the mesh"));
    }
  });
  for (auto const& [diagonal, face] : diagonals_) edges.push_back(diagonal);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

SINEW_ONCE SplitEdges::SplitEdges(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                                  ElementNumbers const& elements) {
  auto squaredLength = [&](Edge const& e) {
    return (rest[std::size_t(e[1])] - rest[std::size_t(e[0])]).squaredNorm();
  };
  std::vector<std::tuple<double, Edge>> byLength;
  for (Edge const& e : split(body, wanted(body, elements))) byLength.emplace_back(-squaredLength(e), e);
  std::sort(byLength.begin(), byLength.end());
  for (auto const& [length, e] : byLength) {
    rank_[e] = Index(order_.size());
    order_.push_back(e);
  }
  check(body);
}

// that what is parted can be, and nothing lies across it that is not
SINEW_ONCE void SplitEdges::check(TopologyView const& body) const {
  const bool beside = !body.edges.empty() || !body.triangles.empty() || !body.tetrahedra.empty();
  std::map<Edge, std::string> across;  // diagonals of what is parted
  auto checkCell = [&](int kind, std::size_t number, auto const& cell) {
    const int parted = axes(cell);
    auto name = [&] { return text(element_kind_name(kind), ' ', number); };
    auto points = cell;
    std::sort(points.begin(), points.end());
    if (const auto twice = std::adjacent_find(points.begin(), points.end());
        parted != 0 && twice != points.end())
      throw Error({}, text(name(), " would be parted, and has point ", *twice, " twice; correct it"));
    for (std::size_t i = 0; i < cell.size() && beside; ++i)
      for (std::size_t k = i + 1; k < cell.size(); ++k) {
        const int between = axes_between(i, k);
        if (between == 1 || between == 2 || between == 4) continue;
        const Edge diagonal{std::min(cell[i], cell[k]), std::max(cell[i], cell[k])};
        if (between == 7 && rank(diagonal) >= 0)
          throw Error({},
                      text("edge ",
                           diagonal[0],
                           ' ',
                           diagonal[1],
                           " goes through ",
                           name(),
                           " from corner to corner, and would be split; refine other elements than those "
                           "with this edge, or put them into a topology of their own"));
        if ((between & parted) != 0) across.emplace(diagonal, name());
      }
  };
  for_each_kind(body, [&](int kind, auto const& list) {
    constexpr std::size_t corners = std::tuple_size_v<std::decay_t<decltype(list[0])>>;
    for (std::size_t e = 0; e < list.size() && !is_simplex(kind); ++e) {
      if constexpr (corners == 4 || corners == 8)
        checkCell(kind, e, list[e]);
      else
        for_each_edge(list[e], [&](Edge const& pair) {
          if (rank(pair) >= 0) detail::refuse_refinement(kind, e);
        });
    }
  });
  if (across.empty()) return;
  std::set<Edge> sides;  // of triangles and tetrahedra, which stay those of their parts
  for (Triangle const& t : body.triangles) for_each_edge(t, [&](Edge const& e) { sides.insert(e); });
  for (Tetrahedron const& t : body.tetrahedra) for_each_edge(t, [&](Edge const& e) { sides.insert(e); });
  for_each_kind(body, [&](int kind, auto const& list) {
    for (std::size_t e = 0; e < list.size() && is_simplex(kind); ++e) {
      bool parted = false;
      auto lies = across.end();
      for_each_edge(list[e], [&](Edge const& pair) {
        parted = parted || rank(pair) >= 0 || (kind == int(ElementKind::edge) && sides.contains(pair));
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
