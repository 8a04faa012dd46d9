// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/scene/topology_edit.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace sinew {

/// What is to be removed from the topology of the node at a path from the root.
struct Carved {
  std::string path{};
  ElementNumbers elements{};
  std::size_t count = 0;
};

/// Which elements the tools of the carving managers of a scene touch.
template <class RootScope>
struct Carving {
  RootScope const& root;

  /// Throws Error where a manager has no tool, or nothing to carve.
  void check() const {
    traverse(root, on<role::Carving>([&](auto& carving, auto const& scope) { check(carving, scope); }));
  }

  /// After detection. Empty where nothing is touched.
  std::vector<Carved> touched() const {
    std::vector<Carved> all;
    traverse(root, on<role::Carving>([&](auto& carving, auto const& scope) {
               if (!carving.active) return;
               scope.withContacts([&](auto const& manager) { find(carving, manager, all); });
             }));
    return all;
  }

 private:
  using Corners = std::array<int, 3>;

  template <class C, class S>
  void check(C& carving, S const& scope) const {
    auto wrong = [&](auto const&... what) {
      throw Error(scope.path(), text(component_name<C>(), ": ", what...));
    };
    bool detects = false;
    scope.withContacts([&](auto&) { detects = true; });
    if (!detects) wrong("no node above has a DefaultPipeline, whose contacts it needs; add one to its node");
    if (carving.toolModel.empty())
      wrong("toolModel is not given; name the node of the tool's collision model");
    std::string const &tool = carving.tool = path_from(scope.path(), carving.toolModel),
                      &body = carving.body = path_from(scope.path(), carving.surfaceModelPath);
    bool hasTool = false, hasBody = false;
    std::string models;
    traverse(root, on<role::CollisionModel>([&](auto const& model, auto const& s) {
               const std::string path = s.path();
               models += text(models.empty() ? "" : ", ", path);
               if (is_below(path, tool))
                 hasTool = true;
               else if (is_below(path, body) && model.surface.shape == Shape::triangle)
                 hasBody = hasBody || bodyUnder(s.stateAddress()).address;
             }));
    if (!hasTool)
      wrong("toolModel leads to ", tool, ", where there is no collision model; there is one at: ", models);
    if (!hasBody)
      wrong("there is nothing to carve: at or below ",
            body,
            " no triangle collision model is over elements that can be removed; give the body a "
            "TriangleCollisionModel over a topology that lists its elements");
    traverse(root, on<role::Intersection>([&](auto const& intersection, auto const&) {
               if (carving.carvingDistance && *carving.carvingDistance > intersection.reach())
                 wrong("carvingDistance is ",
                       *carving.carvingDistance,
                       " m, but contacts are looked for up to ",
                       intersection.reach(),
                       " m only; raise the alarm distance");
             }));
  }

  struct Body {
    void const* address = nullptr;  // of the topology whose elements are removed
    TopologyView view{};
    std::string path{};
  };
  /// Of the editable topologies over a state, and over those of whose points its own are copies, the one with
  /// elements of the highest dimension; of several the first of the uppermost.
  Body bodyUnder(void const* state) const {
    Body best;
    int highest = 1;
    void const* stateOfBest = nullptr;
    while (state) {
      traverse(root, on<role::Topology>([&](auto& t, auto const& scope) {
                 if constexpr (editable_topology<std::decay_t<decltype(t)>>) {
                   if (scope.pointsAddress() != state) return;
                   const TopologyView view = t.view();
                   const int dimension = dimension_of(view);
                   if (dimension < highest || (dimension == highest && stateOfBest == state) || dimension < 2)
                     return;
                   highest = dimension, stateOfBest = state;
                   best = {&t, view, scope.path()};
                 }
               }));
      void const* above = nullptr;
      traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
                 if constexpr (requires { std::decay_t<decltype(mapping)>::samePoints; })
                   scope.withMapped(mapping, [&](auto&, auto& child, auto& parent) {
                     if (&child == state) above = &parent;
                   });
               }));
      state = above;
    }
    return best;
  }

  template <class C, class Manager>
  void find(C& carving, Manager const& manager, std::vector<Carved>& all) const {
    auto near = [&](Contact const& c) {
      return carving.carvingDistance ? c.distance <= *carving.carvingDistance : c.distance < c.limit;
    };
    if (std::none_of(manager.contacts.begin(), manager.contacts.end(), near)) return;
    std::string const &tool = carving.tool, &body = carving.body;
    for (std::size_t s = 0; s < manager.surfaces.size(); ++s) {
      CollisionSurface const& surface = *manager.surfaces[s];
      if (surface.shape != Shape::triangle || is_below(surface.path, tool) || !is_below(surface.path, body))
        continue;
      std::vector<Corners> triangles;
      for (Contact const& c : manager.contacts) {
        if (!near(c)) continue;
        for (auto [mine, other] : {std::pair(&c.a, &c.b), std::pair(&c.b, &c.a)})
          if (mine->surface == int(s) && is_below(manager.surfaces[std::size_t(other->surface)]->path, tool))
            triangles.push_back(sorted_corners(surface.elements[std::size_t(mine->element)]));
      }
      if (triangles.empty()) continue;
      const Body under = bodyUnder(surface.state);
      if (under.address) remove(carving, under, triangles, all);
    }
  }

  // the elements of a body over the corners of one of the triangles
  template <class C>
  void remove(C& carving, Body const& body, std::vector<Corners>& triangles, std::vector<Carved>& all) const {
    std::sort(triangles.begin(), triangles.end());
    const std::string path = body.path.substr(std::min(body.path.size(), root.path().size() + 1));
    auto entry = std::find_if(all.begin(), all.end(), [&](Carved const& c) { return c.path == path; });
    if (entry == all.end()) entry = all.insert(all.end(), Carved{path, {}, 0});

    auto collect = [&](auto const& list, std::vector<Index>& numbers) {
      for (std::size_t e = 0; e < list.size(); ++e)
        if (isOver(list[e], triangles)) numbers.push_back(Index(e));
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    };
    ElementNumbers& gone = entry->elements;
    std::size_t whole = 0;
    entry->count = 0;
    std::vector<Index>* some = nullptr;
    for_each_highest(body.view, [&](int kind, auto const& list) {
      std::vector<Index>& numbers = gone.of(kind);
      collect(list, numbers);
      whole += list.size(), entry->count += numbers.size();
      if (!some && !numbers.empty()) some = &numbers;
    });
    if (entry->count < whole || !some) return;
    some->erase(some->begin());
    --entry->count;
    carving.message = text("the last element of ", body.path, " stays: a body must keep one element");
  }
  template <std::size_t N>
  static bool isOver(std::array<Index, N> const& element, std::vector<Corners> const& triangles) {
    auto is = [&](std::size_t i, std::size_t j, std::size_t k) {
      return std::binary_search(
          triangles.begin(), triangles.end(), sorted_corners(Corners{element[i], element[j], element[k]}));
    };
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = i + 1; j < N; ++j)
        for (std::size_t k = j + 1; k < N; ++k)
          if (is(i, j, k)) return true;
    return false;
  }
};

}  // namespace sinew
