// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/scene/topology_edit.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What the components of a scene take out of its topologies before a step.
template <class RootScope>
struct TopologicalChanges {
  RootScope const& root;

  /// Throws Error where there is no topology whose elements can be removed.
  void prepare() const {
    traverse(
        root, on<role::TopologicalChange>([this](auto& c, auto const& scope) {
          const std::string where = text(scope.path(), ": ", component_name<std::decay_t<decltype(c)>>());
          if (!scope.topologyAddress())
            throw Error(where,
                        "neither its node nor one above has a topology; give one of them a MeshTopology");
          if (!this->place(scope).editable)
            throw Error(where,
                        "the elements of its topology are made from a few numbers, and none of them can be "
                        "removed; give the node a MeshTopology with these elements");
          c.prepare(where, scope.topology());
        }));
  }

  /// By remove(path, elements), after which the scene is another one, at the same place. Says whether
  /// something went.
  template <class Remove>
  bool make(double time, StepNotes const& notes, Remove&& remove) const {
    int count = 0;
    traverse(root, on<role::TopologicalChange>([&](auto const&, auto const&) { ++count; }));
    bool any = false;
    for (int number = 0; number < count; ++number)
      for (bool due = true; due;) {
        std::string path;
        ElementNumbers elements;
        bool keepsLast = false;
        at(number, [&](auto& c, auto const& scope) {
          due = find(c, scope, time, elements);
          path = this->place(scope).path;
          keepsLast = due && keepOne(scope.topology(), elements);
          if (keepsLast)
            notes.warn(scope.path(), "the last element of a body stays", [] {
              return "the last element of a body stays: a body keeps one element; take its node out of the "
                     "scene where it is to go (Simulation::change)";
            });
          if constexpr (NoticesChange<std::decay_t<decltype(c)>>)
            if (const std::string_view what = c.notice(); !what.empty())
              notes.warn(scope.path(), what, [&] { return std::string(what); });
        });
        if (!due) break;
        bool some = false;
        for (auto const* list : elements.lists()) some = some || !list->empty();
        if (some) remove(path, elements);
        any = any || some;
        at(number, [](auto& c, auto const&) { c.elementsRemoved(); });
        if (keepsLast) break;  // it would be found again
      }
    return any;
  }

 private:
  struct Place {
    std::string path{};  // from the root
    bool editable = false;
  };
  template <class S>
  Place place(S const& scope) const {
    Place found;
    void const* const address = scope.topologyAddress();
    traverse(root, on<role::Topology>([&](auto& t, auto const& at) {
               if (static_cast<void const*>(&t) != address) return;
               const std::string path = at.path();
               found = {path.substr(std::min(path.size(), root.path().size() + 1)),
                        editable_topology<std::decay_t<decltype(t)>>};
             }));
    return found;
  }
  // Leaves the first element out where all of the highest dimension would go.
  static bool keepOne(TopologyView const& topology, ElementNumbers& elements) {
    auto all = [](auto const& list, std::vector<Index>& numbers) {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      return numbers.size() == list.size();
    };
    auto keep = [&](auto const& a, std::vector<Index>& ofA, auto const& b, std::vector<Index>& ofB) {
      const bool allOfA = all(a, ofA), allOfB = all(b, ofB);
      if (!allOfA || !allOfB) return false;
      auto& from = ofA.empty() ? ofB : ofA;
      from.erase(from.begin());
      return true;
    };
    auto const& t = topology;
    if (!t.tetrahedra.empty() || !t.hexahedra.empty())
      return keep(t.tetrahedra, elements.tetrahedra, t.hexahedra, elements.hexahedra);
    if (!t.triangles.empty() || !t.quads.empty())
      return keep(t.triangles, elements.triangles, t.quads, elements.quads);
    std::vector<Index> none;
    return keep(t.edges, elements.edges, std::vector<Edge>{}, none);
  }
  template <class F>
  void at(int number, F&& f) const {
    int here = 0;
    traverse(root, on<role::TopologicalChange>([&](auto& c, auto const& scope) {
               if (here++ == number) f(c, scope);
             }));
  }
  template <class C, class S>
  static bool find(C& c, S const& scope, double time, ElementNumbers& elements) {
    if constexpr (HasDataTypes<C>)
      return c.findRemoved(
          scope.topology(), scope.template state<typename C::DataTypes>().position, time, elements);
    else
      return c.findRemoved(scope.topology(), time, elements);
  }
};

}  // namespace sinew
