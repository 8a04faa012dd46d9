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

/// Parts elements at the middles of all their edges: an edge in 2, a triangle or a quad in 4, a tetrahedron
/// or a hexahedron in 8. Neighbours are parted with them, into fewer parts, so that faces still match: edges,
/// triangles and tetrahedra by bisection, at one edge after the other, the longest at rest first, in all that
/// have it (Rivara 1984); quads and hexahedra from side to side, in 2, 4 or 8, and with them all along the
/// sheets of their opposite sides (SplitEdges). Empty numbers: all. What is listed beside elements in which
/// it lies, edges of triangles, faces of hexahedra, is refined with them; a list of all edges, or of all
/// faces, is one afterwards, too. Throws Error where a number leads nowhere, where a pyramid, a prism or an
/// element of second order would be parted, or a cell with a point twice, and where an edge goes through
/// such a hexahedron from corner to corner, or lies across a quad without the two halves of it.
Refinement plan_refinement(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                           ElementNumbers const& elements);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>
#include <sinew/topology/split_cells.hpp>
#include <sinew/topology/split_edges.hpp>

#include <algorithm>
#include <set>
#include <vector>

namespace sinew::detail {

class RefinedBody {
 public:
  RefinedBody(TopologyView const& body, std::span<Eigen::Vector3d const> rest, ElementNumbers const& elements)
      : body_(body), edges_(body, rest, elements), points_(rest.size()) {}

  Refinement plan() {
    Refinement r;
    SplitCells cells(edges_, points_, r.parts.points);
    split(ElementKind::edge, body_.edges, r.parts.edges, cells, r);
    split(ElementKind::triangle, body_.triangles, r.parts.triangles, cells, r);
    split(ElementKind::quad, body_.quads, r.parts.quads, cells, r);
    split(ElementKind::tetrahedron, body_.tetrahedra, r.parts.tetrahedra, cells, r);
    split(ElementKind::hexahedron, body_.hexahedra, r.parts.hexahedra, cells, r);
    AddedElements const& parts = r.parts;
    complete(
        ElementKind::triangle,
        body_.triangles,
        r.parts.triangles,
        r,
        [&](auto&& f) { forEachFace(body_.tetrahedra, tetrahedronFaces, f); },
        [&](auto&& f) { forEachFace(parts.tetrahedra, tetrahedronFaces, f); });
    complete(
        ElementKind::quad,
        body_.quads,
        r.parts.quads,
        r,
        [&](auto&& f) { forEachFace(body_.hexahedra, hexahedronFaces, f); },
        [&](auto&& f) { forEachFace(parts.hexahedra, hexahedronFaces, f); });
    completeHalves(r);
    for (const ElementKind of :
         {ElementKind::tetrahedron, ElementKind::hexahedron, ElementKind::triangle, ElementKind::quad}) {
      auto forEachSide = [&](auto const& lists, auto&& f) {
        for_each_kind(lists, [&](int kind, auto const& list) {
          if (kind == int(of))
            for (auto const& e : list) for_each_side(kind, e, f);
        });
      };
      complete(
          ElementKind::edge,
          body_.edges,
          r.parts.edges,
          r,
          [&](auto&& f) { forEachSide(body_, f); },
          [&](auto&& f) { forEachSide(parts, f); });
    }
    return r;
  }

 private:
  TopologyView const& body_;
  SplitEdges edges_;
  std::size_t points_;

  // parts of an edge, a triangle or a tetrahedron, in the order of the split edges
  template <std::size_t N>
  std::vector<std::array<Index, N>> bisected(std::array<Index, N> const& element,
                                             SplitCells const& cells) const {
    std::vector<Index> splits;
    for_each_edge(element, [&](Edge const& e) {
      if (const Index rank = edges_.rank(e); rank >= 0) splits.push_back(rank);
    });
    std::sort(splits.begin(), splits.end());
    std::vector<std::array<Index, N>> all{element};
    for (const Index s : splits) {
      auto const [a, b] = edges_.inOrder()[std::size_t(s)];
      for (std::size_t p = 0, count = all.size(); p < count; ++p) {
        const auto atA = std::find(all[p].begin(), all[p].end(), a),
                   atB = std::find(all[p].begin(), all[p].end(), b);
        if (atA == all[p].end() || atB == all[p].end()) continue;
        auto other = all[p];
        other[std::size_t(atA - all[p].begin())] = cells.middle(s);
        *atB = cells.middle(s);
        all.push_back(other);
      }
    }
    return all;
  }
  template <std::size_t N>
  std::vector<std::array<Index, N>> partsOf(int kind, std::array<Index, N> const& element,
                                            SplitCells& cells) const {
    if constexpr (N == 4 || N == 8)
      if (is_cell(kind)) return cells.parts(element);
    return bisected(element, cells);
  }
  template <class Element>
  void split(ElementKind kind, std::span<Element const> list, std::vector<Element>& come, SplitCells& cells,
             Refinement& r) const {
    auto& ancestors = r.parts.ancestors[std::size_t(kind)];
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto all = partsOf(int(kind), list[i], cells);
      if (all.size() == 1) continue;
      r.whole.of(int(kind)).push_back(Index(i));
      come.insert(come.end(), all.begin(), all.end());
      ancestors.insert(ancestors.end(), all.size(), Index(i));
    }
  }

  template <class Elements, std::size_t Faces, std::size_t F, class Add>
  static void forEachFace(Elements const& elements, std::size_t const (&corners)[Faces][F], Add&& add) {
    for (auto const& element : elements)
      for (auto const& face : corners) {
        std::array<Index, F> f;
        for (std::size_t c = 0; c < F; ++c) f[c] = element[face[c]];
        add(f);
      }
  }
  // the faces that have come within elements, where all faces of these were listed
  template <class Face, class OfElements, class OfParts>
  static void complete(ElementKind kind, std::span<Face const> listed, std::vector<Face>& come, Refinement& r,
                       OfElements&& ofElements, OfParts&& ofParts) {
    if (listed.empty()) return;
    std::set<Face> known;
    for (Face const& f : listed) known.insert(sorted_corners(f));
    bool any = false, all = true;
    ofElements([&](Face const& f) { any = true, all = all && known.contains(sorted_corners(f)); });
    if (!any || !all) return;
    for (Face const& f : come) known.insert(sorted_corners(f));
    ofParts([&](Face const& f) {
      if (!known.insert(sorted_corners(f)).second) return;
      come.push_back(f);
      r.parts.ancestors[std::size_t(kind)].push_back(-1);
    });
  }
  // both halves of the quads that have come within hexahedra, where all quads were listed with theirs
  void completeHalves(Refinement& r) const {
    std::set<Triangle> listed;
    for (Triangle const& t : body_.triangles) listed.insert(sorted_corners(t));
    auto halved = [&](Quad const& q) {
      auto has = [&](Index a, Index b, Index c) {
        return listed.contains(sorted_corners(Triangle{a, b, c}));
      };
      return (has(q[0], q[1], q[2]) && has(q[0], q[2], q[3])) ||
             (has(q[0], q[1], q[3]) && has(q[1], q[2], q[3]));
    };
    if (listed.empty() || !std::all_of(body_.quads.begin(), body_.quads.end(), halved)) return;
    auto const& ancestors = r.parts.ancestors[std::size_t(ElementKind::quad)];
    for (std::size_t k = 0; k < ancestors.size(); ++k)
      if (Quad const& q = r.parts.quads[k]; ancestors[k] < 0) {
        r.parts.triangles.push_back({q[0], q[1], q[2]});
        r.parts.triangles.push_back({q[0], q[2], q[3]});
        r.parts.ancestors[std::size_t(ElementKind::triangle)].insert(
            r.parts.ancestors[std::size_t(ElementKind::triangle)].end(), 2, -1);
      }
  }
};

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Refinement plan_refinement(TopologyView const& body, std::span<Eigen::Vector3d const> rest,
                                      ElementNumbers const& elements) {
  return detail::RefinedBody(body, rest, elements).plan();
}

}  // namespace sinew
#endif
