// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/proximity.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Composes collision detection from the stages that stand in its node, for the models below it: the boxes of
/// all models and their primitives, the broad phase (pairs of models), the narrow phase (pairs of
/// primitives), the intersection method (contacts), the contact manager (their response). Runs at the start
/// of each step.
struct DefaultPipeline {
  using Role = role::CollisionPipeline;
  static constexpr std::string_view className = "DefaultPipeline";
  static constexpr std::string_view aliases = "CollisionPipeline";

  static constexpr auto fields() { return field_list(); }

  std::vector<CollisionSurface*> surfaces{};  // of the step, in the order of the scene
  std::vector<std::pair<int, int>> near{};    // pairs of them
  long boxTests = 0;  // pairs of primitives that the narrow phase found in the last step

  /// Whether two models may collide at all.
  static bool compare(CollisionSurface const& a, CollisionSurface const& b);
  /// Primitives of one body that share a vertex touch there always.
  static bool adjacent(CollisionSurface const& a, int i, CollisionSurface const& b, int j);

  template <class Broad>
  void findNear(Broad& broad) {
    near.clear();
    broad.pairs(std::span<CollisionSurface* const>(surfaces), [&](int i, int j) {
      if (compare(*surfaces[std::size_t(i)], *surfaces[std::size_t(j)])) near.emplace_back(i, j);
    });
  }

  /// Contacts of all pairs, into a manager. `Kinds`: the numbers of corners of the primitives that the scene
  /// has.
  template <std::size_t... Kinds, class Narrow, class Intersection, class Manager>
  void findContacts(std::index_sequence<Kinds...> kinds, Narrow& narrow, Intersection const& intersection,
                    Manager& manager, double dt) {
    boxTests = 0;
    for (auto [i, j] : near) (withKind<Kinds>(kinds, narrow, intersection, manager, i, j, dt), ...);
  }

 private:
  template <std::size_t NA, std::size_t... Kinds, class Narrow, class Intersection, class Manager>
  void withKind(std::index_sequence<Kinds...>, Narrow& narrow, Intersection const& intersection,
                Manager& manager, int i, int j, double dt) {
    if (surfaces[std::size_t(i)]->corners == int(NA))
      (detect<NA, Kinds>(narrow, intersection, manager, i, j, dt), ...);
  }
  template <std::size_t NA, std::size_t NB, class Narrow, class Intersection, class Manager>
  void detect(Narrow& narrow, Intersection const& intersection, Manager& manager, int i, int j, double dt) {
    CollisionSurface const &a = *surfaces[std::size_t(i)], &b = *surfaces[std::size_t(j)];
    if (b.corners != int(NB)) return;
    narrow.pairs(a, b, [&](int elementA, int elementB) {
      ++boxTests;
      if (adjacent(a, elementA, b, elementB)) return;
      const PrimitivePair<NA, NB> pair{a, b, elementA, elementB, dt};
      auto add = [&](Contact& contact) {
        contact.a.surface = i;
        contact.b.surface = j;
        manager.add(contact);
      };
      if constexpr (NA == 0 || NB == 0)
        HullContacts<NA, NB>::find(pair, intersection, add);
      else if (auto contact = intersection.intersect(pair))
        add(*contact);
    });
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE bool DefaultPipeline::compare(CollisionSurface const& a, CollisionSurface const& b) {
  if (!a.active || !b.active || (!a.moving && !b.moving)) return false;
  if ((a.solver < 0 || !a.simulated) && (b.solver < 0 || !b.simulated)) return false;
  // points against triangles and lines against lines are all there is between two surfaces that have the
  // three
  if (a.hasAllKinds() && b.hasAllKinds() && a.corners + b.corners != 4) return false;
  if (&a == &b) return a.selfCollision;
  if (a.state == b.state && !(a.selfCollision && b.selfCollision)) return false;
  return std::find_first_of(a.group.begin(), a.group.end(), b.group.begin(), b.group.end()) == a.group.end();
}

SINEW_ONCE bool DefaultPipeline::adjacent(CollisionSurface const& a, int i, CollisionSurface const& b,
                                          int j) {
  if (a.state != b.state) return false;
  for (const int v : a.elements[std::size_t(i)])
    for (const int w : b.elements[std::size_t(j)])
      if (v >= 0 && v == w) return true;
  return false;
}

}  // namespace sinew
#endif
