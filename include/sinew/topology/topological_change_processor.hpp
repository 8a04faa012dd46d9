// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/io/topological_changes.hpp>
#include <sinew/topology/blade_crossings.hpp>
#include <sinew/topology/incision.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Changes the topology of its node at given times: by a file, or by lists of what goes (useDataInputs). The
/// file removes elements, adds some over the points that are there and points in triangles, and cuts
/// triangles along a path. A change acts at the begin of the first step whose time is not before its own;
/// several that are due follow each other, where SOFA takes the last ones only, and what comes at one time
/// comes together. What a step changes is made whole or not at all. Elements to remove are those of the
/// highest dimension that the topology has, where the file does not say which.
///
/// Numbers are those that SOFA's containers have after each change, in which the last element or point takes
/// the place of one that goes, so that a file means here what it means there. Sinew's own topologies keep the
/// order of what stays. Elements that come stand behind the others, as in SOFA; their shape at rest is that
/// of the rest positions of their points, and points come where they lie in a triangle, at rest and in
/// velocity.
struct TopologicalChangeProcessor {
  using Role = role::TopologicalChange;
  static constexpr std::string_view className = "TopologicalChangeProcessor";
  using What = io::TopologicalEntry::What;

  DataFile filename{};
  double interval = 0, shift = 0;
  bool loop = false, useDataInputs = false;
  double timeToRemove = 0;
  std::vector<int> pointsToRemove{}, edgesToRemove{}, trianglesToRemove{}, quadsToRemove{},
      tetrahedraToRemove{}, hexahedraToRemove{};
  std::vector<Vec<double, 6>> box{};
  bool saveIndicesAtInit = false;
  double epsilonSnapPath = 0.1;

  static constexpr auto fields() {
    using P = TopologicalChangeProcessor;
    auto list = [](std::string_view name, auto member, std::string_view words) {
      return field(name, member, "", words, range::nonNegative);
    };
    return field_list(
        field("filename",
              &P::filename,
              "",
              "text file of changes, each a line \"T= seconds\" and after it \"REMOVE= count\", \"ADD= "
              "Tetrahedra count\" (or another kind, or PointsInTriangle) or \"INCISE= count\" with its "
              "numbers"),
        field("interval",
              &P::interval,
              "s",
              "time between two removals of the lists; 0: there is one",
              range::nonNegative),
        field("shift", &P::shift, "s", "what is added to the time of the scene"),
        field("loop", &P::loop, "", "starts the file again after its last time"),
        field("useDataInputs", &P::useDataInputs, "", "take the lists in the place of the file"),
        field("timeToRemove",
              &P::timeToRemove,
              "s",
              "the lists are removed in the first step that begins later"),
        list("pointsToRemove", &P::pointsToRemove, "numbers of points, which go with the elements over them"),
        list("edgesToRemove", &P::edgesToRemove, "numbers of edges"),
        list("trianglesToRemove", &P::trianglesToRemove, "numbers of triangles"),
        list("quadsToRemove", &P::quadsToRemove, "numbers of quads"),
        list("tetrahedraToRemove", &P::tetrahedraToRemove, "numbers of tetrahedra"),
        list("hexahedraToRemove", &P::hexahedraToRemove, "numbers of hexahedra"),
        field(
            "box",
            &P::box,
            "m",
            "the elements go that lie in one of these at the time, two opposite corners each: xmin ymin zmin "
            "xmax ymax zmax; a list that is linked to a BoxROI over moving points gives it"),
        field("saveIndicesAtInit",
              &P::saveIndicesAtInit,
              "",
              "whether paths of incisions lie on the surface at rest, and follow it"),
        field("epsilonSnapPath",
              &P::epsilonSnapPath,
              "",
              "an incision passes through a point that is nearer to it than this part of an edge",
              range::closed(0, 0.5)));
  }

  int done = 0;  // changes so far
  // by SOFA's numbers, those of the topology; empty while these are the same
  std::vector<int> edges{}, triangles{}, quads{}, tetrahedra{}, hexahedra{}, points{};
  std::vector<io::TopologicalEntry> changes{};  // of the file
  int taken = 0;                                // of these, by the change that is being made
  std::string_view noticed{};
  // of incisions: what the blade was not done with, and where the last one ended
  CutFront front{};
  int stroke = 0;
  std::optional<Eigen::Vector3d> end{};

  static constexpr auto state() {
    using P = TopologicalChangeProcessor;
    auto numbers = [](std::string_view name, auto member) {
      return field(
          name, member, "", "by SOFA's numbers, those here; none: they are the same", range::nonNegative);
    };
    return field_list(field("done", &P::done, "", "changes so far", range::nonNegative),
                      numbers("edge_numbers", &P::edges),
                      numbers("triangle_numbers", &P::triangles),
                      numbers("quad_numbers", &P::quads),
                      numbers("tetrahedron_numbers", &P::tetrahedra),
                      numbers("hexahedron_numbers", &P::hexahedra),
                      numbers("point_numbers", &P::points));
  }
  /// Times are those of another run. What has gone or come stays so, and so a file that adds or cuts goes on
  /// from where it was.
  void reset() {
    if (std::all_of(changes.begin(), changes.end(), [](auto const& c) { return c.what == What::remove; }))
      done = 0;
    front = {};
    end.reset();
  }

  bool mayAdd(std::string const&) {
    if (useDataInputs || filename.path.empty()) return false;
    changes = io::read_topological_changes(filename.path);
    return std::any_of(changes.begin(), changes.end(), [](auto const& c) { return c.what == What::add; });
  }

  void prepare(std::string const& where, TopologyView const& topology) {
    const auto lists = inputs();
    const bool given = !box.empty() || std::any_of(lists.begin(), lists.end(), [](auto const* list) {
      return !list->empty();
    });
    bool adds = false;
    if (useDataInputs) {
      if (!given)
        throw Error(where,
                    "useDataInputs is set and there is nothing to remove; give numbers of elements, such as "
                    "trianglesToRemove");
      checkNumbers(where, topology);
    } else if (given) {
      throw Error(
          where, "lists of elements or boxes are given, but not taken; set useDataInputs, or leave them out");
    } else if (filename.path.empty()) {
      throw Error(where,
                  "there is nothing to do; give the file of changes (filename), or useDataInputs and numbers "
                  "of elements");
    } else {
      adds = mayAdd(where);
      if (loop && !(changes.back().time > 0))
        throw Error(where, "the file ends at time 0, and cannot go round in a loop; give later times");
    }
    for_each_kind(topology, [&](int kind, auto const& list) {
      if (kind < listed_kinds || list.empty()) return;
      throw Error(where,
                  text("the topology of its node has a ",
                       element_kind_name(kind),
                       ", which neither lists nor files name; "
                       "remove them by a TopologyBoundingTrasher, or a CarvingManager"));
    });
    if (kindOf(topology) < 0 && !adds && pointsToRemove.empty())
      throw Error(where, "the topology of its node has no elements that could be removed; give it some");
  }

  bool findChange(TopologyView const& topology, std::size_t pointCount, double time,
                  TopologicalOrder& order) {
    noticed = {};
    taken = 1;
    const Sizes size = sizes(topology, pointCount);
    forgetOthers(size);
    if (useDataInputs) {
      const double due = done == 0      ? timeToRemove
                         : interval > 0 ? timeToRemove + done * interval
                                        : std::numeric_limits<double>::infinity();
      if (due >= time + shift) return false;
      const auto from = inputs();
      for (std::size_t kind = 0; kind < kinds; ++kind) take(kind, *from[kind], size, order.gone);
      order.box = box;
      return true;
    }
    io::TopologicalEntry const* next = due(done, time + shift);
    if (!next) return false;
    if (next->isShort)
      noticed = "fewer numbers follow REMOVE= in the file than it says; those missing count as 0, as in SOFA";
    if (next->isLong)
      noticed = "more numbers follow a change in the file than it says; they are left out, as in SOFA";
    if (next->what == What::remove) {
      if (const int kind = kindOf(topology); kind >= 0)
        take(std::size_t(kind), next->numbers, size, order.gone);
      else if (!next->numbers.empty())
        noticed = gone;
    } else if (next->what == What::incise) {
      for (std::size_t k = 0; k + 2 < next->values.size(); k += 3)
        order.incision.push_back({next->values[k], next->values[k + 1], next->values[k + 2]});
    } else {
      // what comes at one time comes together, as far as it is no part of what comes
      const double at = next->time;
      for (taken = 0; next && isAddition(*next) && next->time == at && (taken == 0 || stands(*next, size));) {
        add(*next, topology, size, order.added);
        ++taken;
        if (std::size_t(done + taken) % changes.size() == 0) break;
        next = due(done + taken, time + shift);
      }
    }
    return true;
  }
  void changeMade() { done += taken; }

  /// The stroke along a path, of points that are at x; one that begins near the end of the last goes on with
  /// it.
  BladeStroke incise(std::vector<Eigen::Vector3d> const& path, std::vector<Eigen::Vector3d> const& x,
                     std::vector<Eigen::Vector3d> const& rest, TopologyView const& topology) {
    const Blade blade = incision_blade(path, topology.triangles, x, saveIndicesAtInit ? rest : x);
    if (end && (path.front() - *end).norm() > (blade.to[0] - blade.from[0]).norm() / 2) ++stroke;
    end = path.back();
    return {SweptBlade("an incision", blade), stroke};
  }
  CutRules rules() const { return {.snapping = epsilonSnapPath}; }

  void followElements(TopologyChange const& change) {
    front = {};
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      auto& all = this->*lists_of[kind];
      Renumbering const& r = kind < listed_kinds ? change.elements[kind] : change.points;
      if (!r.changes()) continue;
      if (all.size() != r.now.size()) {
        all.clear();
        if (r.kept.size() == r.now.size()) continue;  // the same numbers still
        for (std::size_t i = 0; i < r.now.size(); ++i) all.push_back(int(i));
      }
      for (std::size_t i = all.size(); i-- > 0;)
        if (!r.stays(all[i])) {
          all[i] = all.back();
          all.pop_back();
        }
      for (int& e : all) r.renumber(e);
      for (std::size_t k = 0; k < r.come.size(); ++k) all.push_back(int(r.kept.size() + k));
    }
  }
  std::string_view notice() const { return noticed; }

 private:
  // of its lists and files, which end with hexahedra; points are behind them
  static constexpr int listed_kinds = int(ElementKind::hexahedron) + 1;
  static constexpr std::size_t kinds = listed_kinds + 1;
  using Sizes = std::array<std::size_t, kinds>;
  static constexpr std::string_view gone = "elements to remove are not there any more";
  static constexpr std::array<std::vector<int> TopologicalChangeProcessor::*, kinds> lists_of{
      &TopologicalChangeProcessor::edges,
      &TopologicalChangeProcessor::triangles,
      &TopologicalChangeProcessor::quads,
      &TopologicalChangeProcessor::tetrahedra,
      &TopologicalChangeProcessor::hexahedra,
      &TopologicalChangeProcessor::points};

  std::array<std::vector<int> const*, kinds> inputs() const {
    return {&edgesToRemove,
            &trianglesToRemove,
            &quadsToRemove,
            &tetrahedraToRemove,
            &hexahedraToRemove,
            &pointsToRemove};
  }
  static Sizes sizes(TopologyView const& t, std::size_t pointCount) {
    return {t.edges.size(),
            t.triangles.size(),
            t.quads.size(),
            t.tetrahedra.size(),
            t.hexahedra.size(),
            pointCount};
  }
  // that of the highest dimension; -1 for none
  static int kindOf(TopologyView const& topology) {
    const Sizes size = sizes(topology, 0);
    for (int kind = listed_kinds; kind-- > 0;)
      if (size[std::size_t(kind)] > 0) return kind;
    return -1;
  }
  // numbers of another topology
  void forgetOthers(Sizes const& size) {
    for (std::size_t kind = 0; kind < kinds; ++kind)
      if (auto& all = this->*lists_of[kind]; all.size() != size[kind]) all.clear();
  }
  void checkNumbers(std::string const& where, TopologyView const& topology) const {
    const Sizes size = sizes(topology, 0);
    const auto from = inputs();
    for (std::size_t kind = 0; kind < listed_kinds; ++kind)
      for (const int e : *from[kind])
        if (e < 0 || std::size_t(e) >= size[kind])
          throw Error(where,
                      text(element_kind_name(int(kind)),
                           ' ',
                           e,
                           " is to be removed, but the topology has ",
                           size[kind],
                           ", numbered from 0; correct the number"));
  }
  // the change of a number in the order in which they are made; null where it is not due
  io::TopologicalEntry const* due(int number, double now) const {
    const auto count = int(changes.size());
    if (number >= count && !loop) return nullptr;
    io::TopologicalEntry const& next = changes[std::size_t(number % count)];
    // times that differ by rounding are the same, as in SOFA
    const double at = next.time + number / count * changes.back().time;
    return at > now && std::abs(at - now) >= std::numeric_limits<double>::epsilon() ? nullptr : &next;
  }
  int numberOf(std::size_t kind, int number) const {
    auto const& all = this->*lists_of[kind];
    return std::size_t(number) < all.size() ? all[std::size_t(number)] : number;
  }
  void take(std::size_t kind, std::vector<int> const& wanted, Sizes const& size, ElementNumbers& elements) {
    std::array<std::vector<Index>*, kinds> const lists{&elements.edges,
                                                       &elements.triangles,
                                                       &elements.quads,
                                                       &elements.tetrahedra,
                                                       &elements.hexahedra,
                                                       &elements.points};
    for (const int e : wanted)
      if (e >= 0 && std::size_t(e) < size[kind])
        lists[kind]->push_back(numberOf(kind, e));
      else
        noticed = gone;
  }

  static bool isAddition(io::TopologicalEntry const& e) {
    return e.what == What::add || e.what == What::addPoints;
  }
  // whether what it is a part of is there
  static bool stands(io::TopologicalEntry const& e, Sizes const& size) {
    const bool inTriangles = e.what == What::addPoints;
    auto const& of = inTriangles ? e.numbers : e.ancestors;
    const std::size_t count = size[inTriangles ? 1 : std::size_t(e.kind)];
    return std::all_of(of.begin(), of.end(), [&](int i) { return std::size_t(i) < count; });
  }
  void add(io::TopologicalEntry const& e, TopologyView const& topology, Sizes const& size,
           AddedElements& added) const {
    if (e.what == What::addPoints) {
      for (std::size_t k = 0; k < e.numbers.size(); ++k) {
        const int number = numberOf(1, e.numbers[k]);
        if (std::size_t(number) >= size[1])
          throw Error({},
                      text("a point is to come in triangle ",
                           number,
                           ", but there are ",
                           size[1],
                           ", numbered from 0; correct the number"));
        Triangle const& t = topology.triangles[std::size_t(number)];
        const double a = e.values[2 * k], b = e.values[2 * k + 1];
        added.points.push_back({t[0], t[1], b, t[2], 1 - a - b});
      }
      return;
    }
    std::size_t corner = 0;
    auto more = [&](auto& list) {
      while (corner < e.numbers.size()) {
        list.emplace_back();
        for (Index& i : list.back()) i = numberOf(listed_kinds, e.numbers[corner++]);
      }
    };
    std::size_t before = 0;
    auto behind = [&](auto& list) {
      before = list.size();
      more(list);
      auto& ancestors = added.ancestors[std::size_t(e.kind)];
      if (before > 0 && ancestors.empty() != e.ancestors.empty())
        throw Error(
            {},
            "some elements that come at one time have ancestors, and others have none; give all of a kind "
            "some");
      for (const int a : e.ancestors) ancestors.push_back(numberOf(std::size_t(e.kind), a));
    };
    switch (ElementKind(e.kind)) {
      case ElementKind::edge:
        return behind(added.edges);
      case ElementKind::triangle:
        return behind(added.triangles);
      case ElementKind::quad:
        return behind(added.quads);
      case ElementKind::tetrahedron:
        return behind(added.tetrahedra);
      case ElementKind::hexahedron:
        return behind(added.hexahedra);
      case ElementKind::pyramid:
      case ElementKind::prism:
      case ElementKind::quadraticTetrahedron:
      case ElementKind::quadraticHexahedron:
      case ElementKind::triquadraticHexahedron:
        return;
    }
  }
};

}  // namespace sinew
