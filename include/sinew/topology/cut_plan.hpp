// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/add_plan.hpp>
#include <sinew/topology/cut_rules.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace sinew {

/// What becomes of the elements of all topologies over the points of a body that is cut.
struct CutPlan {
  using Lists = AddPlan::Lists;
  Renumbering points{};
  std::vector<TopologyChange> ofTopology{};  // of each
  std::vector<Lists> lists{};                // what each has then
  CutFront front{};
  std::vector<Edge> split{};                 // edges that have come apart, in rising order
  std::vector<std::array<Edge, 2>> moved{};  // edges with a point that is there twice: before, and now
  std::size_t elements = 0;                  // through which the blade has gone
  std::size_t faces = 0;                     // that part

  bool changes() const { return points.changes(); }
};

/// A cut along the edges that a blade has crossed, by the points of the elements: tetrahedra of
/// topologies[first], or its triangles where it has none.
///
///   1. An element is cut when the blade has gone through all of it: crossed all edges between two groups of
///      its points. Before that the crossings wait, so that a cut ends at faces and edges of elements (Mor,
///      Kanade 2000 keep to elements that are cut through; Steinemann, Harders, Gross, Szekely 2006).
///   2. Where a crossing is near a point, the cut passes through the point, which stays where it is; so it
///   does
///      too where an element would come that is too bad. (Steinemann et al. and Paulus, Untereiner,
///      Courtecuisse, Cotin, Cazier 2015 move the point; here no volume, mass, strain or momentum changes.)
///   3. The other edges are split, one after the other, in all elements that have them.
///   4. Faces all of whose points lie in the cut part, where the elements beside them are on different sides
///   of
///      it: each of their points is there once for each group of elements around it that still hang together
///      by faces.
///
/// All topologies are over the same points; triangles (of a surface: edges) that are the whole border of the
/// elements, in a list that `growsBorder` names, get the faces that are laid bare. Throws Error where there
/// would be more points than the rules allow.
CutPlan plan_cut(std::vector<Eigen::Vector3d> const& rest, std::vector<TopologyView> const& topologies,
                 std::size_t first, std::vector<bool> const& growsBorder, CutFront const& crossed,
                 CutRules const& rules);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/cut_lists.hpp>

#include <span>
#include <utility>

namespace sinew::detail {

template <std::size_t N>
CutPlan plan_cut_of(std::vector<Eigen::Vector3d> const& rest, std::span<std::array<Index, N> const> elements,
                    std::vector<TopologyView> const& topologies, std::size_t first,
                    std::vector<bool> const& growsBorder, CutFront const& crossed, CutRules const& rules) {
  CutPlan plan;
  const CutEdges<N> edges(rest, elements, crossed, rules);
  plan.elements = edges.whole;
  plan.points = Renumbering::grown(rest.size(), {});
  plan.front = {edges.crossings, crossed.points, crossed.sides, crossed.faces};
  if (plan.elements == 0) return plan;
  const CutParts<N> parts(edges, crossed.faces);
  const CutLists<N> cut(edges, parts);
  plan.faces = cut.facesApart();
  plan.front = cut.front();
  plan.split = cut.splitEdges();
  plan.moved = cut.movedEdges();
  plan.points = Renumbering::grown(rest.size(), parts.origins);
  if (plan.points.size() > rules.capacity)
    throw Error({},
                text("the body would have ",
                     plan.points.size(),
                     " points, and may have ",
                     rules.capacity,
                     "; raise the capacity, or cut less finely (snapping)"));
  for (std::size_t t = 0; t < topologies.size(); ++t) {
    TopologyView const& view = topologies[t];
    CutPlan::Lists lists{.quads = {view.quads.begin(), view.quads.end()}};  // of what is only looked at
    TopologyChange change{.points = plan.points};
    // (nvcc looks names up again where it instantiates, and sinew::detail may have got an ElementKind by
    // then)
    using Kind = sinew::ElementKind;
    auto record = [&](Kind kind, auto const& before, std::vector<Origin> come) {
      change.elements[std::size_t(kind)] = Renumbering::grown(before.size(), std::move(come));
    };
    std::vector<Origin> come;
    lists.edges = cut.template follow<2>(view.edges, come);
    record(Kind::edge, view.edges, std::exchange(come, {}));
    if (N == 3 && t == first) {
      if constexpr (N == 3) lists.triangles = cut.elements(come);
    } else {
      lists.triangles = cut.template follow<3>(view.triangles, come);
    }
    record(Kind::triangle, view.triangles, std::exchange(come, {}));
    if constexpr (N == 4) {
      lists.tetrahedra = t == first ? cut.elements(come) : cut.template follow<4>(view.tetrahedra, come);
      record(Kind::tetrahedron, view.tetrahedra, std::exchange(come, {}));
    }
    if (growsBorder[t]) {
      if constexpr (N == 4)
        cut.addBare(cut.isBorder(view.triangles), lists.triangles);
      else
        cut.addBare(cut.isBorder(view.edges), lists.edges);
    }
    plan.ofTopology.push_back(std::move(change));
    plan.lists.push_back(std::move(lists));
  }
  return plan;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE CutPlan plan_cut(std::vector<Eigen::Vector3d> const& rest,
                            std::vector<TopologyView> const& topologies, std::size_t first,
                            std::vector<bool> const& growsBorder, CutFront const& crossed,
                            CutRules const& rules) {
  TopologyView const& body = topologies[first];
  if (!body.tetrahedra.empty())
    return detail::plan_cut_of<4>(rest, body.tetrahedra, topologies, first, growsBorder, crossed, rules);
  return detail::plan_cut_of<3>(rest, body.triangles, topologies, first, growsBorder, crossed, rules);
}

}  // namespace sinew
#endif
