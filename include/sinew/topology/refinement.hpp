// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <Eigen/Core>
#include <span>

namespace sinew {

/// What comes in the place of elements that are refined.
struct Refinement {
  AddedElements parts{};   // with the elements of which they are
  ElementNumbers whole{};  // those
};

/// Parts edges, triangles and tetrahedra at the middles of all their edges: an edge in 2, a triangle in 4, a
/// tetrahedron in 8. The edges are split one after the other, the longest at rest first, in all elements that
/// have them (bisection: Rivara 1984), so that neighbours are parted with them, into fewer parts, and faces
/// still match. Empty numbers: all. Where edges are listed beside triangles or tetrahedra, or triangles
/// beside tetrahedra, these are refined with them; a list of all edges, or of all faces, is one afterwards,
/// too. Throws Error where a number leads nowhere, and where quads, hexahedra, pyramids or prisms would have
/// to be parted.
Refinement plan_refinement(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                           ElementNumbers const& elements);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace sinew::detail {

class SplitEdges {
 public:
  SplitEdges(TopologyView const& body, std::span<Eigen::Vector3d const> rest, ElementNumbers const& elements)
      : body_(body) {
    const auto lists = elements.lists();
    const bool all = std::all_of(lists.begin(), lists.end(), [](auto const* l) { return l->empty(); });
    std::set<Edge> edges;
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
        if (!isSimplex(kind)) refuse(kind);
        forEachEdge(list[std::size_t(number)], [&](Edge const& e) { edges.insert(e); });
      };
      if (all)
        for (std::size_t i = 0; i < list.size(); ++i) take(Index(i));
      else
        for (const Index i : *lists[std::size_t(kind)]) take(i);
    });
    auto squaredLength = [&](Edge const& e) {
      return (rest[std::size_t(e[1])] - rest[std::size_t(e[0])]).squaredNorm();
    };
    std::vector<std::tuple<double, Edge>> byLength;
    for (Edge const& e : edges) byLength.emplace_back(-squaredLength(e), e);
    std::sort(byLength.begin(), byLength.end());
    for (auto const& [length, e] : byLength) {
      rank_[e] = Index(order_.size());
      order_.push_back(e);
    }
    for_each_kind(body, [&](int kind, auto const& list) {
      if (isSimplex(kind)) return;
      for (auto const& element : list)
        for (const Index a : element)
          for (const Index b : element)
            if (a < b && rank_.contains({a, b})) refuse(kind);
    });
  }

  Refinement plan(std::size_t points) const {
    Refinement r;
    for (Edge const& e : order_) r.parts.points.push_back({e[0], e[1], 0.5});
    split(ElementKind::edge, body_.edges, points, r.parts.edges, r);
    split(ElementKind::triangle, body_.triangles, points, r.parts.triangles, r);
    split(ElementKind::tetrahedron, body_.tetrahedra, points, r.parts.tetrahedra, r);
    complete<3>(
        body_.tetrahedra, r.parts.tetrahedra, body_.triangles, ElementKind::triangle, r.parts.triangles, r);
    if (body_.tetrahedra.empty())
      complete<2>(body_.triangles, r.parts.triangles, body_.edges, ElementKind::edge, r.parts.edges, r);
    else
      complete<2>(body_.tetrahedra, r.parts.tetrahedra, body_.edges, ElementKind::edge, r.parts.edges, r);
    return r;
  }

 private:
  TopologyView const& body_;
  std::vector<Edge> order_{};
  std::map<Edge, Index> rank_{};

  static bool isSimplex(int kind) {
    return kind == int(ElementKind::edge) || kind == int(ElementKind::triangle) ||
           kind == int(ElementKind::tetrahedron);
  }
  [[noreturn]] static void refuse(int kind) {
    throw Error({},
                text("a ",
                     element_kind_name(kind),
                     " is not refined while a scene runs; refine the mesh before (MeshSubdivision), or "
                     "give the body tetrahedra or triangles"));
  }
  template <std::size_t N, class F>
  static void forEachEdge(std::array<Index, N> const& element, F&& f) {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = i + 1; k < N; ++k)
        f(Edge{std::min(element[i], element[k]), std::max(element[i], element[k])});
  }

  // its parts, in the order of the edges
  template <std::size_t N>
  std::vector<std::array<Index, N>> parts(std::array<Index, N> const& element, std::size_t points) const {
    std::vector<Index> splits;
    forEachEdge(element, [&](Edge const& e) {
      if (const auto found = rank_.find(e); found != rank_.end()) splits.push_back(found->second);
    });
    std::sort(splits.begin(), splits.end());
    std::vector<std::array<Index, N>> all{element};
    for (const Index s : splits) {
      auto const [a, b] = order_[std::size_t(s)];
      for (std::size_t p = 0, count = all.size(); p < count; ++p) {
        const auto atA = std::find(all[p].begin(), all[p].end(), a),
                   atB = std::find(all[p].begin(), all[p].end(), b);
        if (atA == all[p].end() || atB == all[p].end()) continue;
        auto other = all[p];
        other[std::size_t(atA - all[p].begin())] = Index(points) + s;
        *atB = Index(points) + s;
        all.push_back(other);
      }
    }
    return all;
  }
  template <std::size_t N>
  void split(ElementKind kind, std::span<std::array<Index, N> const> list, std::size_t points,
             std::vector<std::array<Index, N>>& come, Refinement& r) const {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto all = parts(list[i], points);
      if (all.size() == 1) continue;
      r.whole.of(int(kind)).push_back(Index(i));
      come.insert(come.end(), all.begin(), all.end());
      r.parts.ancestors[std::size_t(kind)].insert(
          r.parts.ancestors[std::size_t(kind)].end(), all.size(), Index(i));
    }
  }

  template <std::size_t F, std::size_t N, class Add>
  static void forEachFace(std::array<Index, N> const& element, Add&& add) {
    std::array<Index, F> face{};
    auto choose = [&](auto const& self, std::size_t from, std::size_t have) -> void {
      if (have == F) return add(sorted_corners(face));
      for (std::size_t i = from; i < N; ++i) {
        face[have] = element[i];
        self(self, i + 1, have + 1);
      }
    };
    choose(choose, 0, 0);
  }
  // the faces with F corners that have come within elements, where all faces were listed
  template <std::size_t F, std::size_t N>
  static void complete(std::span<std::array<Index, N> const> elements,
                       std::vector<std::array<Index, N>> const& parts,
                       std::span<std::array<Index, F> const> listed, ElementKind kind,
                       std::vector<std::array<Index, F>>& come, Refinement& r) {
    if (listed.empty() || elements.empty()) return;
    std::set<std::array<Index, F>> known, faces;
    for (auto const& f : listed) known.insert(sorted_corners(f));
    for (auto const& e : elements) forEachFace<F>(e, [&](auto const& f) { faces.insert(f); });
    if (!std::includes(known.begin(), known.end(), faces.begin(), faces.end())) return;
    for (auto const& f : come) known.insert(sorted_corners(f));
    for (auto const& e : parts)
      forEachFace<F>(e, [&](auto const& f) {
        if (!known.insert(f).second) return;
        come.push_back(f);
        r.parts.ancestors[std::size_t(kind)].push_back(-1);
      });
  }
};

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Refinement plan_refinement(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                                      ElementNumbers const& elements) {
  return detail::SplitEdges(body, rest, elements).plan(rest.size());
}

}  // namespace sinew
#endif
