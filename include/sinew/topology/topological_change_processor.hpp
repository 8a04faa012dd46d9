// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/io/topological_changes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Removes elements of the topology of its node at given times: from a file, or from lists (useDataInputs). A
/// change acts at the begin of the first step whose time is not before its own; several that are due follow
/// each other, where SOFA takes the last one only. Elements are those of the highest dimension that the
/// topology has, where the file does not say which.
///
/// Numbers are those that SOFA's containers have after each change, in which the last element takes the place
/// of one that goes, so that a file means here what it means there. Sinew's own topologies keep the order of
/// what stays.
struct TopologicalChangeProcessor {
  using Role = role::TopologicalChange;
  static constexpr std::string_view className = "TopologicalChangeProcessor";

  DataFile filename{};
  double interval = 0, shift = 0;
  bool loop = false, useDataInputs = false;
  double timeToRemove = 0;
  std::vector<int> edgesToRemove{}, trianglesToRemove{}, quadsToRemove{}, tetrahedraToRemove{},
      hexahedraToRemove{};

  static constexpr auto fields() {
    using P = TopologicalChangeProcessor;
    auto list = [](std::string_view name, auto member, std::string_view words) {
      return field(name, member, "", words, range::nonNegative);
    };
    return field_list(
        field("filename",
              &P::filename,
              "",
              "text file of changes, each a line \"T= seconds\" and after it \"REMOVE= count\" with as many "
              "numbers of elements"),
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
        list("edgesToRemove", &P::edgesToRemove, "numbers of edges"),
        list("trianglesToRemove", &P::trianglesToRemove, "numbers of triangles"),
        list("quadsToRemove", &P::quadsToRemove, "numbers of quads"),
        list("tetrahedraToRemove", &P::tetrahedraToRemove, "numbers of tetrahedra"),
        list("hexahedraToRemove", &P::hexahedraToRemove, "numbers of hexahedra"));
  }

  int done = 0;                                           // changes so far
  std::array<std::vector<int>, element_kinds> numbers{};  // of each kind, by SOFA's numbers
  std::vector<io::TopologicalRemoval> changes{};          // of the file
  std::string_view noticed{};

  static constexpr auto state() {
    using P = TopologicalChangeProcessor;
    return field_list(field("done", &P::done, "", "changes so far", range::nonNegative));
  }
  /// Times are those of another run; what has gone stays so.
  void reset() { done = 0; }

  void prepare(std::string const& where, TopologyView const& topology) {
    const auto lists = inputs();
    const bool given =
        std::any_of(lists.begin(), lists.end(), [](auto const* list) { return !list->empty(); });
    if (useDataInputs) {
      if (!given)
        throw Error(where,
                    "useDataInputs is set and there is nothing to remove; give numbers of elements, such as "
                    "trianglesToRemove");
      checkNumbers(where, topology);
    } else if (given) {
      throw Error(where, "lists of elements are given, but not taken; set useDataInputs, or leave them out");
    } else if (filename.path.empty()) {
      throw Error(where,
                  "there is nothing to do; give the file of changes (filename), or useDataInputs and numbers "
                  "of elements");
    } else {
      changes = io::read_topological_changes(filename.path);
      if (loop && !(changes.back().time > 0))
        throw Error(where, "the file ends at time 0, and cannot go round in a loop; give later times");
    }
    if (kindOf(topology) < 0)
      throw Error(where, "the topology of its node has no elements that could be removed; give it some");
    resetNumbers(topology);
  }

  bool findRemoved(TopologyView const& topology, double time, ElementNumbers& elements) {
    noticed = {};
    resetNumbers(topology);
    if (useDataInputs) {
      const double due = done == 0      ? timeToRemove
                         : interval > 0 ? timeToRemove + done * interval
                                        : std::numeric_limits<double>::infinity();
      if (due >= time + shift) return false;
      const auto from = inputs();
      for (int kind = 0; kind < element_kinds; ++kind) take(kind, *from[std::size_t(kind)], elements);
      return true;
    }
    const auto count = int(changes.size());
    if (done >= count && !loop) return false;
    io::TopologicalRemoval const& next = changes[std::size_t(done % count)];
    // times that differ by rounding are the same, as in SOFA
    const double due = next.time + done / count * changes.back().time, now = time + shift;
    if (due > now && std::abs(due - now) >= std::numeric_limits<double>::epsilon()) return false;
    take(kindOf(topology), next.elements, elements);
    if (next.isShort)
      noticed = "fewer numbers follow REMOVE= in the file than it says; those missing count as 0, as in SOFA";
    return true;
  }
  void elementsRemoved() { ++done; }
  void followElements(TopologyChange const& change) {
    for (int kind = 0; kind < element_kinds; ++kind) {
      auto& all = numbers[std::size_t(kind)];
      Renumbering const& renumbering = change.elements[std::size_t(kind)];
      if (!renumbering.changes()) continue;
      for (std::size_t i = all.size(); i-- > 0;)
        if (!renumbering.stays(all[i])) {
          all[i] = all.back();
          all.pop_back();
        }
      for (int& e : all) renumbering.renumber(e);
    }
  }
  std::string_view notice() const { return noticed; }

 private:
  std::array<std::vector<int> const*, element_kinds> inputs() const {
    return {&edgesToRemove, &trianglesToRemove, &quadsToRemove, &tetrahedraToRemove, &hexahedraToRemove};
  }
  static std::array<std::size_t, element_kinds> sizes(TopologyView const& t) {
    return {t.edges.size(), t.triangles.size(), t.quads.size(), t.tetrahedra.size(), t.hexahedra.size()};
  }
  // that of the highest dimension; -1 for none
  static int kindOf(TopologyView const& topology) {
    const auto size = sizes(topology);
    for (int kind = element_kinds; kind-- > 0;)
      if (size[std::size_t(kind)] > 0) return kind;
    return -1;
  }
  // those of the topology where they are not known
  void resetNumbers(TopologyView const& topology) {
    const auto size = sizes(topology);
    for (std::size_t kind = 0; kind < size.size(); ++kind)
      if (numbers[kind].size() != size[kind]) {
        numbers[kind].resize(size[kind]);
        for (std::size_t i = 0; i < size[kind]; ++i) numbers[kind][i] = int(i);
      }
  }
  void checkNumbers(std::string const& where, TopologyView const& topology) const {
    const auto size = sizes(topology);
    const auto from = inputs();
    for (int kind = 0; kind < element_kinds; ++kind)
      for (const int e : *from[std::size_t(kind)])
        if (e < 0 || std::size_t(e) >= size[std::size_t(kind)])
          throw Error(where,
                      text(element_kind_name(kind),
                           ' ',
                           e,
                           " is to be removed, but the topology has ",
                           size[std::size_t(kind)],
                           ", numbered from 0; correct the number"));
  }
  void take(int kind, std::vector<int> const& wanted, ElementNumbers& elements) {
    std::array<std::vector<Index>*, element_kinds> const lists{
        &elements.edges, &elements.triangles, &elements.quads, &elements.tetrahedra, &elements.hexahedra};
    auto const& known = numbers[std::size_t(kind)];
    for (const int e : wanted)
      if (e >= 0 && std::size_t(e) < known.size())
        lists[std::size_t(kind)]->push_back(known[std::size_t(e)]);
      else
        noticed = "elements to remove are not there any more";
  }
};

}  // namespace sinew
