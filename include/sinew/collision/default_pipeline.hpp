// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/grid_contacts.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/collision/solid_contacts.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Composes collision detection from the stages that stand in its node, for the models below it: the boxes of
/// all models and their primitives, the broad phase (pairs of models), the narrow phase (pairs of
/// primitives), the intersection method (contacts), the contact manager (their response). Runs at the start
/// of each step, or behind its free motion where the intersection method looks at that.
struct DefaultPipeline {
  using Role = role::CollisionPipeline;
  static constexpr std::string_view className = "DefaultPipeline";
  static constexpr std::string_view aliases = "CollisionPipeline";

  static constexpr auto fields() { return field_list(); }

  std::vector<CollisionSurface*> surfaces{};  // of the step, in the order of the scene
  std::vector<std::pair<int, int>> near{};    // pairs of them
  bool begun = false;                         // a device looks for the contacts of the step
  bool afterFreeMotion = false;               // they are found behind the free motion of the step
  long boxTests = 0;  // pairs of primitives that the narrow phase found in the last step
  // primitives of two models whose boxes meet: those that are found one after the other are met together
  std::array<std::pair<int, int>, 256> candidates{};
  std::size_t count = 0;
  std::vector<Contact> inSolids{};  // of two models
  GridSearch gridSearch{};

  /// Whether two models may collide at all; those that one frame carries cannot.
  static bool compare(CollisionSurface const& a, CollisionSurface const& b);
  /// Primitives of one body that share a vertex touch there always, and what moves as one cannot be parted.
  static bool adjacent(CollisionSurface const& a, int i, CollisionSurface const& b, int j);

  template <class Broad>
  void findNear(Broad& broad) {
    near.clear();
    broad.pairs(std::span<CollisionSurface* const>(surfaces), [&](int i, int j) {
      if (compare(*surfaces[std::size_t(i)], *surfaces[std::size_t(j)])) near.emplace_back(i, j);
    });
  }

  /// Contacts of all pairs, into a manager. `Known`: the shapes that the scene has, without radii.
  template <Shape... Known, class Narrow, class Intersection, class Manager>
  void findContacts(ShapeList<Known...> known, Narrow& narrow, Intersection const& intersection,
                    Manager& manager, double dt) {
    boxTests = 0;
    count = 0;
    for (auto const& pair : near) {
      const int i = pair.first, j = pair.second;
      CollisionSurface const &a = *surfaces[std::size_t(i)], &b = *surfaces[std::size_t(j)];
      if (a.grid || b.grid) {
        for (const bool first : {true, false}) {
          CollisionSurface const &grid = first ? a : b, &other = first ? b : a;
          if (!grid.grid || a.state == b.state) continue;
          const double proximity = a.settings.proximity + b.settings.proximity;
          find_in_grid(grid,
                       other,
                       limitOf(intersection, a, b),
                       intersection.reach() + proximity,
                       first,
                       gridSearch,
                       inSolids);
          for (Contact& contact : inSolids) AddTo<Manager>{manager, i, j}(contact);
          inSolids.clear();
        }
        continue;
      }
      if constexpr (MeetsModels<Narrow>)
        if (narrow.meets(a, b)) {
          narrow.contacts(a, b, limitOf(intersection, a, b), AddTo<Manager>{manager, i, j});
          continue;
        }
      for (const bool first : {true, false}) {
        CollisionSurface const &solid = first ? a : b, &points = first ? b : a;
        if (solid.solid.empty() || skeleton(points.shape) != Shape::point || a.state == b.state) continue;
        find_in_solid(solid, points, limitOf(intersection, a, b), first, inSolids);
        for (Contact& contact : inSolids) AddTo<Manager>{manager, i, j}(contact);
        inSolids.clear();
      }
      if (!compares(intersection, a, b)) continue;
      narrow.pairs(a, b, [&](int elementA, int elementB) {
        ++boxTests;
        if (adjacent(a, elementA, b, elementB)) return;
        candidates[count++] = {elementA, elementB};
        if (count == candidates.size()) meet(known, intersection, manager, i, j, dt);
      });
      meet(known, intersection, manager, i, j, dt);
    }
  }

 private:
  template <class Intersection>
  static bool compares(Intersection const& intersection, CollisionSurface const& a,
                       CollisionSurface const& b) {
    if constexpr (ChoosesModels<Intersection>)
      return intersection.compares(a, b);
    else
      return has_pairs(a, b);
  }
  template <Shape... Known, class Intersection, class Manager>
  void meet(ShapeList<Known...> known, Intersection const& intersection, Manager& manager, int i, int j,
            double dt) {
    if (count > 0) (withShape<Known>(known, intersection, manager, i, j, dt), ...);
    count = 0;
  }

  // the distance below which contacts of two models that no method has found are answered
  template <class Intersection>
  static double limitOf(Intersection const& intersection, CollisionSurface const& a,
                        CollisionSurface const& b) {
    const double proximity = a.settings.proximity + b.settings.proximity;
    if constexpr (MeetsHulls<Intersection>)
      return intersection.limit() + proximity;
    else
      return intersection.reach() + proximity;
  }

  template <class Manager>
  struct AddTo {
    Manager& manager;
    int i, j;
    void operator()(Contact& contact) const {
      contact.a.surface = i;
      contact.b.surface = j;
      manager.add(contact);
    }
  };

  template <Shape A, Shape... Known, class Intersection, class Manager>
  void withShape(ShapeList<Known...>, Intersection const& intersection, Manager& manager, int i, int j,
                 double dt) const {
    constexpr bool hasPoints = ((Known == Shape::point) || ...);
    if (skeleton(surfaces[std::size_t(i)]->shape) == A)
      (intersect<A, Known, hasPoints>(intersection, manager, i, j, dt), ...);
  }
  // f for a primitive, and the ends that capsules have for themselves: f<shape>(first of its corners)
  template <Shape S, bool HasPoints, class F>
  static void forEachPart(CollisionSurface const& s, F&& f) {
    f.template operator()<S>(0);
    if constexpr (S == Shape::line && HasPoints)
      for (int end = 0; s.shape == Shape::capsule && end < 2; ++end) f.template operator()<Shape::point>(end);
  }
  template <Shape A, Shape B, bool HasPoints, class Intersection, class Manager>
  void intersect(Intersection const& intersection, Manager& manager, int i, int j, double dt) const {
    CollisionSurface const &a = *surfaces[std::size_t(i)], &b = *surfaces[std::size_t(j)];
    if (skeleton(b.shape) != B) return;
    const double cone = manager.coneOf(i, j);
    const AddTo<Manager> add{manager, i, j};
    for (auto [elementA, elementB] : std::span(candidates.data(), count)) {
      const int e = elementA, f = elementB;
      if constexpr (A == Shape::hull || B == Shape::hull)
        HullContacts<A, B>::find(PrimitivePair<A, B>{a, b, e, f, dt, cone}, intersection, add);
      else
        forEachPart<A, HasPoints>(a, [&]<Shape OfA>(int firstA) {
          forEachPart<B, HasPoints>(b, [&]<Shape OfB>(int firstB) {
            static_assert(Intersects<Intersection, OfA, OfB>,
                          "Sinew: an intersection method has no 'std::optional<Contact> "
                          "intersect(PrimitivePair<A, B> const& pair) const' for two shapes of the scene.");
            if (auto contact =
                    intersection.intersect(PrimitivePair<OfA, OfB>{a, b, e, f, dt, cone, firstA, firstB}))
              add(*contact);
          });
        });
    }
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE bool DefaultPipeline::compare(CollisionSurface const& a, CollisionSurface const& b) {
  CollisionSettings const &ofA = a.settings, &ofB = b.settings;
  if (!ofA.active || !ofB.active || (!ofA.moving && !ofB.moving)) return false;
  if ((a.solver < 0 || !ofA.simulated) && (b.solver < 0 || !ofB.simulated)) return false;
  if (a.carrier >= 0 && a.carrier == b.carrier) return false;
  if (&a == &b) return ofA.selfCollision;
  if (a.state == b.state && !(ofA.selfCollision && ofB.selfCollision)) return false;
  return std::find_first_of(ofA.group.begin(), ofA.group.end(), ofB.group.begin(), ofB.group.end()) ==
         ofA.group.end();
}

SINEW_ONCE bool DefaultPipeline::adjacent(CollisionSurface const& a, int i, CollisionSurface const& b,
                                          int j) {
  if (a.isOneWith(i, b, j)) return true;
  if (a.state != b.state) return false;
  for (const int v : a.elements[std::size_t(i)])
    for (const int w : b.elements[std::size_t(j)])
      if (v >= 0 && v == w) return true;
  return false;
}

}  // namespace sinew
#endif
