// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/state/vector_operations.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sinew {

/// DataTypes that find contacts of their points where these are, and the violations of what answers them: the
/// workspace of their states has what does it, `contacts` (gpu/contact_search.hpp).
template <class D>
concept FindsContacts = requires { requires VectorOperations<D>::findsContacts; };

namespace detail {

template <class C>
constexpr bool is_found_by_states() {
  if constexpr (HasRole<C, role::CollisionModel>)
    return FindsContacts<typename C::DataTypes> && skeleton(C::shape) == Shape::point;
  else
    return false;
}
template <class S>
constexpr bool states_find_contacts();
template <class S, class... Cs, class... Ns>
constexpr bool states_find_contacts(NodeParts<hana::tuple<Cs...>, hana::tuple<Ns...>> const*) {
  return (false || ... || is_found_by_states<Cs>()) ||
         (false || ... || states_find_contacts<typename ScopeOf<Ns, S>::type>());
}
/// Whether there may be models of points below a scope whose DataTypes find contacts.
template <class S>
constexpr bool states_find_contacts() {
  if constexpr (requires { S::provedAtInit; }) {
    bool some = false;
    for_each_registered<typename S::Classes>(
        [&]<class C>() constexpr { some = some || is_found_by_states<C>(); });
    return some;
  } else {
    return states_find_contacts<S>(static_cast<typename S::NodeType const*>(nullptr));
  }
}

/// An intersection method that takes surfaces of any kind, and so those of a device.
template <class I>
concept MeetsAnySurface = requires(I const i, PrimitivePair<Shape::point, Shape::triangle, int, char> pair,
                                   Contact c) { i.find(pair, c); };

}  // namespace detail

/// The contacts below a collision pipeline, whose scope is `scope`, found by states for models of points and
/// spheres against surfaces that no solver moves. Either all pairs of models that may meet are such, or the
/// host finds all.
template <class S>
struct StateContacts {
  S const& scope;

  static constexpr bool possible = detail::states_find_contacts<S>();

  /// Why the host has to find them; empty where it need not. `surfaces`: all, in the order of the scene.
  template <class Pipeline, class Manager, class Intersection>
  std::string_view reason(std::vector<CollisionSurface*> const& surfaces, Pipeline const& pipeline,
                          Manager const& manager, Intersection const&) const {
    if constexpr (!detail::MeetsAnySurface<Intersection> || Intersection::continuous ||
                  ChoosesModels<Intersection>) {
      return "the intersection method is none that a device has; take MinProximityIntersection";
    } else {
      if (!manager.attachments.empty()) return "a place is held from outside";
      if (manager.couplesAgain) return "contacts have changed from outside";
      for (std::size_t i = 0; i < surfaces.size(); ++i)
        for (std::size_t j = i; j < surfaces.size(); ++j) {
          CollisionSurface const &a = *surfaces[i], &b = *surfaces[j];
          if (!pipeline.compare(a, b) || !has_pairs(a, b)) continue;
          if (!manager.answersMeasuring(int(i), int(j)))
            return "a response is none that a device has; take FrictionContactConstraint";
          if (!(moves(a) && stands(b)) && !(moves(b) && stands(a)))
            return "two models may meet of which none is one of points or spheres over the DataTypes of a "
                   "device, or the other one is moved by a solver, rigid, or of hulls; put what moves on the "
                   "device as points, and what stands as triangles, lines, points or spheres";
        }
      return {};
    }
  }

  /// Begins the search.
  template <class Pipeline, class Manager, class Intersection>
  void begin(Pipeline const& pipeline, Manager const& manager, Intersection const& method) const {
    auto const& surfaces = pipeline.surfaces;
    for (auto* s : surfaces)
      if (s->solver < 0) s->enclose(method.reach() / 2, 0);
    eachSearch([&](CollisionSurface& mine, auto& state, auto& search) {
      search.begin(mine, std::size_t(manager.capacity));
      for (auto const* s : surfaces)
        if (stands(*s) && mayMeet(pipeline, mine, *s))
          search.add(*s, s->number < mine.number, method.reach());
      search.look(method, std::as_const(state.position));
    });
  }
  /// What its contacts are to those of the step before: others; of the same vertices; or those in the same
  /// directions, so that their rows are the same but for violations.
  enum class Found { others, same, sameRows };

  /// Its contacts into the manager, by whose manage() they are to be managed where they are others. Vertices
  /// that touch are on the host then.
  template <class Manager, class Intersection>
  Found finish(Manager& manager, Intersection const& method) const {
    std::size_t count = 0;
    bool same = true, sameDirections = true;
    eachSearch([&](CollisionSurface& mine, auto& state, auto& search) {
      manager.grown += search.take(method, std::as_const(state.position));
      using Again = typename std::decay_t<decltype(search)>::Again;
      same = same && search.again() != Again::no;
      sameDirections = sameDirections && search.again() == Again::sameDirections;
      count += search.found().size();
      for (auto const& found : search.found()) {
        if (found.vertices[0] < 0) detail::refuse_place(mine, found.element);
        mine.position[std::size_t(mine.elements[std::size_t(found.element)][0])] = found.point;
      }
    });
    // (the manager may have left some out)
    same = same && manager.contacts.size() == count;
    for (Contact const& c : manager.contacts) same = same && c.place >= 0 && c.response >= 0;
    eachSearch([&](CollisionSurface& mine, auto&, auto& search) {
      if (same) {
        for (Contact& c : manager.contacts)
          if (c.a.surface == mine.number || c.b.surface == mine.number)
            place(c, mine, search.found()[std::size_t(c.place)], c.place);
        return search.accept();
      }
      int number = 0;
      for (auto const& found : search.found()) {
        Contact& c = manager.addNew();
        const int other = search.numberOf(found.surface);
        c.a.surface = std::min(other, mine.number);
        c.b.surface = std::max(other, mine.number);
        place(c, mine, found, number++);
      }
      search.accept();
    });
    return !same ? Found::others : sameDirections ? Found::sameRows : Found::same;
  }

  /// f(model's surface, its state, what searches for it) for the models whose contacts states find.
  template <class F>
  void eachSearch(F&& f) const {
    if constexpr (possible)
      for_each_collision_model(scope, [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
        if constexpr (detail::is_found_by_states<std::decay_t<decltype(model)>>())
          if (model.surface.elsewhere) f(model.surface, s, s.solverWorkspace.contacts);
      });
  }

  // (those of models over such DataTypes are marked as `elsewhere` before)
  static bool moves(CollisionSurface const& s) { return s.elsewhere; }
  static bool stands(CollisionSurface const& s) {
    return s.solver < 0 && !s.rigid && (is_simplex(s.shape) || s.shape == Shape::sphere) && !s.elsewhere;
  }

 private:
  template <class Found>
  void place(Contact& c, CollisionSurface const& mine, Found const& found, int number) const {
    const bool first = c.a.surface == mine.number;
    ContactSide &own = first ? c.a : c.b, &its = first ? c.b : c.a;
    own.element = found.element;
    own.vertices[0] = mine.elements[std::size_t(found.element)][0];
    own.weights[0] = 1;
    its.element = found.other;
    its.vertices = found.vertices;
    for (std::size_t k = 0; k < 3; ++k) its.weights[k] = found.weights[Eigen::Index(k)];
    const Eigen::Vector3d between = found.standing - found.point;
    c.start = first ? between : Eigen::Vector3d(-between);
    c.normal = found.normal;
    c.thickness = found.thickness;
    c.limit = found.limit;
    c.distance = found.distance;
    c.place = number;
    c.isNew = false;
  }
  template <class Pipeline>
  static bool mayMeet(Pipeline const& pipeline, CollisionSurface const& mine, CollisionSurface const& other) {
    return mine.number < other.number ? pipeline.compare(mine, other) && has_pairs(mine, other)
                                      : pipeline.compare(other, mine) && has_pairs(other, mine);
  }
};

}  // namespace sinew
