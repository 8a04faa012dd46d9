// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <string_view>
#include <vector>

namespace sinew {

/// What becomes of the elements of all topologies over the points of a body that gets some.
struct AddPlan {
  struct Lists {
    std::vector<Edge> edges{};
    std::vector<Triangle> triangles{};
    std::vector<Quad> quads{};
    std::vector<Tetrahedron> tetrahedra{};
    std::vector<Hexahedron> hexahedra{};
    std::vector<Pyramid> pyramids{};
    std::vector<Prism> prisms{};
    std::vector<QuadraticTetrahedron> quadraticTetrahedra{};
    std::vector<QuadraticHexahedron> quadraticHexahedra{};
    std::vector<TriquadraticHexahedron> triquadraticHexahedra{};

    /// f(kind, list) for each kind.
    template <class F>
    void forEach(F&& f) {
      for_each_kind(*this, f);
    }
  };
  Renumbering points{};
  std::vector<TopologyChange> ofTopology{};  // of each
  std::vector<Lists> lists{};                // what each has then
};

/// A topology, or a visual model, over the points of a body.
struct TopologyOfBody {
  TopologyView view;
  std::string_view conversion{};  // the class of the topological mapping that makes it, where it is known
  int copies = -1;                // the topology whose faces it has where it has none of its own; -1: none
};

/// Puts elements behind those of topologies[first], over its points and those that come. Others follow that
/// have the same elements of a kind, the border of its volumes or faces, or two triangles for each quad:
/// faces that come inside go, those that are laid bare come behind what there is, each oriented as those
/// before, and with the values of one in which it lies. So do those that follow these. An element whose parts
/// come no longer counts for a border. A topology without elements follows by its conversion. Throws Error
/// where a point or an ancestor is not there, an element has a point twice or is there already, a place is no
/// number, and where elements of a higher dimension would make another body.
AddPlan plan_addition(std::size_t points, std::vector<TopologyOfBody> const& topologies, std::size_t first,
                      AddedElements const& added);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/border.hpp>
#include <sinew/topology/old_corners.hpp>
#include <sinew/topology/removal_plan.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sinew::detail {

/// Throws Error unless these elements can come to a topology.
inline void check_addition(std::size_t points, TopologyView const& body, AddedElements const& added) {
  for (std::size_t k = 0; k < added.points.size(); ++k) {
    Origin const& o = added.points[k];
    for (const Index i : {o.a, o.b, o.c < 0 ? o.a : o.c})
      if (i < 0 || std::size_t(i) >= points + k)
        throw Error({},
                    text("the new point ",
                         k,
                         " is to lie beside point ",
                         i,
                         ", but there are ",
                         points + k,
                         " points before it, numbered from 0; correct the number"));
    if (!std::isfinite(o.weight) || !std::isfinite(o.weightOfC))
      throw Error({}, text("the place of the new point ", k, " is not a finite number; correct it"));
  }
  const std::size_t all = points + added.points.size();
  int before = 0, now = 0;
  for_each_kind(body, [&](int kind, auto const& list) {
    if (!list.empty()) before = std::max(before, dimension_of_kind(kind));
  });
  added.forEach([&](int kind, auto const& list) {
    const std::string_view name = element_kind_name(kind);
    if (!list.empty()) now = std::max(now, dimension_of_kind(kind));
    auto points_of = [](auto const& element) {
      std::string numbers;
      for (const Index i : element) numbers += text(numbers.empty() ? "" : " ", i);
      return numbers;
    };
    std::set<std::decay_t<decltype(sorted_corners(list[0]))>> known;
    for_each_kind(body, [&](int of, auto const& there) {
      if constexpr (std::is_same_v<std::decay_t<decltype(there[0])>, std::decay_t<decltype(list[0])>>)
        if (of == kind && !list.empty())
          for (auto const& e : there) known.insert(sorted_corners(e));
    });
    for (auto const& e : list) {
      for (const Index i : e)
        if (i < 0 || std::size_t(i) >= all)
          throw Error({},
                      text("the ",
                           name,
                           ' ',
                           points_of(e),
                           " has point ",
                           i,
                           ", but there are ",
                           all,
                           " points, numbered from 0; correct the number"));
      const auto key = sorted_corners(e);
      if (std::adjacent_find(key.begin(), key.end()) != key.end())
        throw Error({}, text("the ", name, ' ', points_of(e), " has a point twice; correct its points"));
      if (!known.insert(key).second)
        throw Error({}, text("the ", name, ' ', points_of(e), " is there already; leave it out"));
    }
    auto const& ancestors = added.ancestors[std::size_t(kind)];
    std::size_t count = 0;
    for_each_kind(body, [&](int of, auto const& there) {
      if (of == kind) count = there.size();
    });
    if (!ancestors.empty() && ancestors.size() != list.size())
      throw Error({},
                  text("there are ",
                       ancestors.size(),
                       " ancestors for ",
                       list.size(),
                       " elements; give one for each, or none"));
    for (const Index a : ancestors)
      if (a < -1 || (a >= 0 && std::size_t(a) >= count))
        throw Error({},
                    text("the ancestor ",
                         a,
                         " is no ",
                         name,
                         ": there are ",
                         count,
                         ", numbered from 0; correct the number"));
  });
  if (before > 0 && now > before)
    throw Error(
        {},
        "elements of a higher dimension than the body has would take the place of its mass and forces; "
        "give them a topology of their own");
}

/// The elements of one topology before and after, and what has become of each.
struct ElementsThatFollow {
  TopologyOfBody const& of;
  AddPlan::Lists lists{};
  std::array<std::vector<bool>, element_kinds> stays{};
  std::array<std::vector<Origin>, element_kinds> come{};
  bool changes = false;

  explicit ElementsThatFollow(TopologyOfBody const& topology) : of(topology) {
    TopologyView const& t = topology.view;
    lists = {{t.edges.begin(), t.edges.end()},
             {t.triangles.begin(), t.triangles.end()},
             {t.quads.begin(), t.quads.end()},
             {t.tetrahedra.begin(), t.tetrahedra.end()},
             {t.hexahedra.begin(), t.hexahedra.end()},
             {t.pyramids.begin(), t.pyramids.end()},
             {t.prisms.begin(), t.prisms.end()},
             {t.quadraticTetrahedra.begin(), t.quadraticTetrahedra.end()},
             {t.quadraticHexahedra.begin(), t.quadraticHexahedra.end()},
             {t.triquadraticHexahedra.begin(), t.triquadraticHexahedra.end()}};
    lists.forEach([&](int kind, auto const& list) { stays[std::size_t(kind)].assign(list.size(), true); });
  }
  void add(AddedElements const& added) {
    lists.forEach([&](int kind, auto& list) {
      added.forEach([&](int ofKind, auto const& more) {
        if constexpr (std::is_same_v<decltype(more), std::decay_t<decltype(list)> const&>) {
          if (ofKind != kind || more.empty()) return;
          list.insert(list.end(), more.begin(), more.end());
          auto const& ancestors = added.ancestors[std::size_t(kind)];
          for (std::size_t k = 0; k < more.size(); ++k)
            come[std::size_t(kind)].push_back(ancestors.empty() || ancestors[k] < 0
                                                  ? Origin::none()
                                                  : Origin{ancestors[k], ancestors[k], 0});
          changes = true;
        }
      });
    });
  }

  /// A list that is the same as that of a source.
  template <class List>
  void copy(int kind, List& list, List const& source, ElementsThatFollow const& from) {
    list = source;
    stays[std::size_t(kind)] = from.stays[std::size_t(kind)];
    come[std::size_t(kind)] = from.come[std::size_t(kind)];
    changes = changes || from.changes;
  }
  /// A list that is a border, which is another one now.
  template <class Face>
  void border(int kind, std::vector<Face>& list, std::vector<Face> const& before,
              std::vector<Face> const& after, int orientation, OldCorners const& old) {
    const auto was = keys(before), is = keys(after);
    std::vector<Face> now;
    std::map<Face, Index> gone;
    for (std::size_t f = 0; f < list.size(); ++f) {
      const bool here = std::binary_search(is.begin(), is.end(), sorted_corners(list[f]));
      stays[std::size_t(kind)][f] = here;
      changes = changes || !here;
      if (here)
        now.push_back(list[f]);
      else
        gone[sorted_corners(list[f])] = Index(f);
    }
    for (Face f : after) {
      if (std::binary_search(was.begin(), was.end(), sorted_corners(f))) continue;
      if (orientation < 0) std::reverse(f.begin(), f.end());
      now.push_back(f);
      const auto outer = old.around(f);
      const auto whole = outer ? gone.find(*outer) : gone.end();
      come[std::size_t(kind)].push_back(whole == gone.end() ? Origin::none()
                                                            : Origin{whole->second, whole->second, 0});
      changes = true;
    }
    list = std::move(now);
  }
  /// Which way a list is the border: 1 or -1; 0 where it is not. `edges`: of a surface, whose sides the faces
  /// are.
  template <class Face>
  static int listed(std::span<Face const> list, std::vector<Face> const& border) {
    if (list.empty() || list.size() != border.size()) return 0;
    if (keys(std::vector<Face>(list.begin(), list.end())) != keys(border)) return 0;
    const Face key = sorted_corners(list[0]);
    for (Face const& f : border)
      if (sorted_corners(f) == key) {
        const auto at = std::size_t(std::find(f.begin(), f.end(), list[0][0]) - f.begin());
        if constexpr (std::tuple_size_v<Face> == 2) return at == 0 ? 1 : -1;
        return f[(at + 1) % f.size()] == list[0][1] ? 1 : -1;
      }
    return 0;
  }
  template <class Face>
  static std::vector<Face> keys(std::vector<Face> all) {
    for (Face& f : all) f = sorted_corners(f);
    std::sort(all.begin(), all.end());
    return all;
  }

  TopologyChange change(Renumbering const& points) const {
    TopologyChange c{.points = points};
    for (std::size_t k = 0; k < element_kinds; ++k) {
      c.elements[k] = Renumbering::of(stays[k]);
      c.elements[k].come = come[k];
    }
    return c;
  }
};

// the elements of a kind without those in whose place their parts have come
template <class Element>
std::vector<Element> outermost(ElementsThatFollow const& source, ElementKind kind,
                               std::vector<Element> const& list) {
  std::set<Index> parted;
  for (Origin const& o : source.come[std::size_t(kind)])
    if (!o.isNone()) parted.insert(o.a);
  auto const& stays = source.stays[std::size_t(kind)];
  std::vector<Element> left;
  std::size_t now = 0;
  for (std::size_t old = 0; old < stays.size(); ++old) {
    if (!stays[old]) continue;
    if (!parted.contains(Index(old))) left.push_back(list[now]);
    ++now;
  }
  left.insert(left.end(), list.begin() + std::ptrdiff_t(now), list.end());
  return left;
}
inline std::vector<Edge> border_edges(std::span<Triangle const> triangles, std::span<Quad const> quads = {}) {
  constexpr std::size_t sides[3][2] = {{0, 1}, {1, 2}, {2, 0}},
                        ofQuads[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  return FacesOfElements<2>{}.add(triangles, sides).add(quads, ofQuads).border();
}
// two triangles of each quad, one behind the other, round as it is (1) or the other way (-1); 0: they are not
inline int halves(std::span<Triangle const> triangles, std::span<Quad const> quads) {
  if (quads.empty() || triangles.size() != 2 * quads.size()) return 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!contains(quads[t / 2], triangles[t])) return 0;
  auto const& q = quads[0];
  const auto at = [&](std::size_t k) { return std::find(q.begin(), q.end(), triangles[0][k]) - q.begin(); };
  return (at(1) - at(0) + 4) % 4 < (at(2) - at(0) + 4) % 4 ? 1 : -1;
}

/// Follows a source where it is made of that; says whether it is.
inline bool follow_source(ElementsThatFollow& t, ElementsThatFollow const& source, bool isCopy,
                          OldCorners const& old) {
  TopologyView const &is = t.of.view, &from = source.of.view;
  const bool reversed = t.of.conversion.ends_with(" flipNormals");
  const std::string_view conversion = t.of.conversion.substr(0, t.of.conversion.find(' '));
  bool any = false;
  auto same = [&](int kind, auto const& a, auto const& b, auto& list, auto const& lists) {
    if (!(a.empty() ? isCopy && kind < 3 : true) || !std::equal(a.begin(), a.end(), b.begin(), b.end()))
      return;
    t.copy(kind, list, lists, source);
    any = true;
  };
  same(0, is.edges, from.edges, t.lists.edges, source.lists.edges);
  same(1, is.triangles, from.triangles, t.lists.triangles, source.lists.triangles);
  same(2, is.quads, from.quads, t.lists.quads, source.lists.quads);
  same(3, is.tetrahedra, from.tetrahedra, t.lists.tetrahedra, source.lists.tetrahedra);
  same(4, is.hexahedra, from.hexahedra, t.lists.hexahedra, source.lists.hexahedra);
  same(5, is.pyramids, from.pyramids, t.lists.pyramids, source.lists.pyramids);
  same(6, is.prisms, from.prisms, t.lists.prisms, source.lists.prisms);
  same(7,
       is.quadraticTetrahedra,
       from.quadraticTetrahedra,
       t.lists.quadraticTetrahedra,
       source.lists.quadraticTetrahedra);
  same(8,
       is.quadraticHexahedra,
       from.quadraticHexahedra,
       t.lists.quadraticHexahedra,
       source.lists.quadraticHexahedra);
  same(9,
       is.triquadraticHexahedra,
       from.triquadraticHexahedra,
       t.lists.triquadraticHexahedra,
       source.lists.triquadraticHexahedra);
  if (any) return true;

  // what has no element yet goes by its conversion
  auto made = [&](std::string_view by, auto const& list, int found) {
    return found != 0 ? found : list.empty() && conversion == by ? (reversed ? -1 : 1) : 0;
  };
  const Border was = border_of(from),
               now = border_of(outermost(source, ElementKind::tetrahedron, source.lists.tetrahedra),
                               outermost(source, ElementKind::hexahedron, source.lists.hexahedra),
                               source.lists.pyramids,
                               source.lists.prisms,
                               source.lists.quadraticTetrahedra,
                               source.lists.quadraticHexahedra,
                               source.lists.triquadraticHexahedra);
  if (const int o = made("Tetra2TriangleTopologicalMapping",
                         is.triangles,
                         ElementsThatFollow::listed(is.triangles, was.triangles));
      o != 0 && !now.triangles.empty())
    t.border(1, t.lists.triangles, was.triangles, now.triangles, o, old), any = true;
  if (const int o =
          made("Hexa2QuadTopologicalMapping", is.quads, ElementsThatFollow::listed(is.quads, was.quads));
      o != 0 && !now.quads.empty())
    t.border(2, t.lists.quads, was.quads, now.quads, o, old), any = true;
  if (any) return true;
  if (const int o = made("Quad2TriangleTopologicalMapping", is.triangles, halves(is.triangles, from.quads));
      o != 0 && !source.lists.quads.empty()) {
    // those of a quad go and come with it
    std::vector<Triangle> triangles;
    for (std::size_t q = 0; q < source.stays[2].size(); ++q)
      for (std::size_t k = 2 * q; k < 2 * q + 2; ++k) {
        t.stays[1][k] = source.stays[2][q];
        if (source.stays[2][q]) triangles.push_back(t.lists.triangles[k]);
      }
    for (std::size_t k = 0; k < source.come[2].size(); ++k) {
      Quad const& q = source.lists.quads[source.lists.quads.size() - source.come[2].size() + k];
      for (Triangle half : {Triangle{q[1], q[2], q[0]}, Triangle{q[3], q[0], q[2]}}) {
        if (o < 0) std::reverse(half.begin(), half.end());
        triangles.push_back(half);
        Origin of = source.come[2][k];
        if (!of.isNone()) of.a = of.b = 2 * of.a + Index(triangles.size() % 2 == 0);
        t.come[1].push_back(of);
      }
    }
    t.lists.triangles = std::move(triangles);
    t.changes = true;
    return true;
  }
  const auto triangles = outermost(source, ElementKind::triangle, source.lists.triangles);
  const auto edgesWere = border_edges(from.triangles);
  if (const int o =
          made("Triangle2EdgeTopologicalMapping", is.edges, ElementsThatFollow::listed(is.edges, edgesWere));
      o != 0 && !source.lists.triangles.empty()) {
    t.border(0, t.lists.edges, edgesWere, border_edges(triangles), o, old);
    return true;
  }
  const auto rimWas = border_edges(from.triangles, from.quads);
  if (const int o = ElementsThatFollow::listed(is.edges, rimWas); o != 0) {
    const auto quads = outermost(source, ElementKind::quad, source.lists.quads);
    t.border(0, t.lists.edges, rimWas, border_edges(triangles, quads), o, old);
    return true;
  }
  return false;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE AddPlan plan_addition(std::size_t points, std::vector<TopologyOfBody> const& topologies,
                                 std::size_t first, AddedElements const& added) {
  detail::check_addition(points, topologies[first].view, added);
  AddPlan plan{.points = Renumbering::grown(points, added.points)};
  std::vector<detail::ElementsThatFollow> all;
  for (TopologyOfBody const& t : topologies) all.emplace_back(t);
  all[first].add(added);
  const OldCorners old(points, added.points);
  // those that follow it stand behind it, and may be followed themselves
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (t == first) continue;
    for (std::size_t from = all.size(); from-- > 0;)
      if (from != t && all[from].changes && (from == first || from < t) &&
          detail::follow_source(all[t], all[from], topologies[t].copies == int(from), old))
        break;
  }
  for (auto& t : all) {
    plan.ofTopology.push_back(t.change(plan.points));
    plan.lists.push_back(std::move(t.lists));
  }
  return plan;
}

}  // namespace sinew
#endif
