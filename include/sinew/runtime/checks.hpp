// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scope.hpp>

#include <set>

namespace sinew {

namespace detail {

/// Name of the DataTypes of the state on which components of a scope act; empty where there is none.
template <class R>
std::string_view data_types_at(RuntimeScope<R> const& scope) {
  const RuntimeScope<R> owner = scope.stateScope();
  if (owner.atMount) return owner.mount().dataTypes;
  std::string_view name;
  if (owner.node.state())
    owner.node.state()->component.template visit<role::State>(
        [&](auto const& s) { name = data_types_name<typename std::decay_t<decltype(s)>::DataTypes>::value; });
  return name;
}

template <class R>
struct RuntimeChecker {
  RuntimeScope<R> const& scope;
  RuntimeEntry<R>& entry;

  [[noreturn]] void fail(std::string_view message) const {
    const std::string where = text(scope.path(), ": ", entry.component.name());
    if (entry.origin.empty()) throw Error(where, message);
    throw Error(entry.origin, text(where, ": ", message));
  }

  template <class D>
  void state(RuntimeScope<R> const& at, std::string_view who, std::string_view none) const {
    const std::string_view found = data_types_at(at), wanted = data_types_name<D>::value;
    if (found.empty()) fail(none);
    if (found != wanted)
      fail(text(
          "is over ", wanted, ", but ", who, " is a state over ", found, "; give both the same template"));
  }

  template <class C>
  void operator()(C& c) const {
    if constexpr (JoinsTwo<C>) {
      ends(c);
      if constexpr (HasRole<C, role::ProjectiveConstraint>)
        for (auto* end : entry.ends) {
          if (RuntimeScope<R>(*end).stateScope().mapped())
            fail("acts on a mapped state, which follows its parent; constrain the parent instead");
          if (solver(*end) != solver(scope.node))
            fail("joins bodies under different ODE solvers; put it and both bodies below one solver");
        }
    } else if constexpr (HasRole<C, role::ForceField> || HasRole<C, role::Mass> ||
                         HasRole<C, role::ProjectiveConstraint> || HasRole<C, role::CollisionModel> ||
                         WatchesState<C>) {
      state<typename C::DataTypes>(
          scope,
          "what it acts on",
          "has no state to act on; put it into a node with a MechanicalObject, or below one");
      if (HasRole<C, role::ProjectiveConstraint> && scope.stateScope().mapped())
        fail("acts on a mapped state, which follows its parent; constrain the parent instead");
      if constexpr (!WatchesState<C>) moved(scope);
      if constexpr (HasRole<C, role::CollisionModel>) {
        bool managed = false;
        for (auto* n = &scope.node; n; n = n->parent())
          managed = managed || RuntimeScope<R>(*n).template has<role::CollisionPipeline>();
        if (!managed)
          scope.warn(entry,
                     "collides with nothing: there is no DefaultPipeline above it; put one into the root, with a "
                     "BruteForceBroadPhase, a BVHNarrowPhase, a MinProximityIntersection and a DefaultContactManager");
      }
    } else if constexpr (HasRole<C, role::Mapping>) {
      if constexpr (HasParents<C>)
        mappingWithParents(c);
      else
        mapping<C>();
    } else if constexpr (HasRole<C, role::BroadPhase> || HasRole<C, role::NarrowPhase> ||
                         HasRole<C, role::Intersection> || HasRole<C, role::ContactManager>) {
      if (!scope.template has<role::CollisionPipeline>())
        scope.warn(entry, "does nothing: its node has no DefaultPipeline, which would use it; add one");
    } else if constexpr (HasRole<C, role::OdeSolver>) {
      if constexpr (!stands_beside<C>) {
        auto const* above = scope.node.parent() ? solver(*scope.node.parent()) : nullptr;
        if (above)
          scope.warn(entry,
                     text("does nothing: the ODE solver of '", above->path(), "' above it moves all that is below; remove one"));
        else if (!scope.integrates())
          scope.warn(entry, "does nothing: no state is below that it could move; remove it, or put it above one");
        if (above || !scope.integrates()) return;
      } else if (solver(scope.node) != &scope.node) {
        fail("changes what the ODE solver of its node has done, and there is none; put it behind one");
      }
      if constexpr (C::implicit) {
        bool found = false;
        scope.withLinearSolver([&](auto&) { found = true; });
        if (!found)
          fail("is implicit and finds no linear solver; add one, such as CGLinearSolver, to its node");
      }
    }
  }

  // what a solver asks for its force or mass acts on a state that this solver moves
  void moved(RuntimeScope<R> const& end) const {
    const RuntimeScope<R> owner = end.stateScope();
    auto const* mover = solver(scope.node);
    if (mover && !owner.atMount && solver(owner.node) != mover)
      fail(text("acts on the state of '",
                owner.path(),
                "', which the ODE solver of '",
                mover->path(),
                "' does not move; give its node a MechanicalObject, or put the solver above that state"));
  }

  // the node whose ODE solver moves a node: the topmost that has one and something to move; null where there is none, or above
  // a runtime tree
  static RuntimeNode<R> const* solver(RuntimeNode<R> const& node) {
    if (node.parent())
      if (auto const* above = solver(*node.parent())) return above;
    if (!node.hasIndependent()) return nullptr;
    for (auto const& other : node.components()) {
      bool moves = false;
      other.component.template visit<role::OdeSolver>(
          [&](auto const& ode) { moves = !stands_beside<std::decay_t<decltype(ode)>>; });
      if (moves) return &node;
    }
    return nullptr;
  }

  // whether a traversal comes to a node before another
  static bool before(RuntimeNode<R> const& first, RuntimeNode<R> const& second) {
    auto below = [&](RuntimeNode<R> const& top) {
      for (auto* at = &first; at; at = at->parent())
        if (at == &top) return true;
      return false;
    };
    RuntimeNode<R> const* branch = &second;
    for (auto* at = second.parent(); at; branch = at, at = at->parent()) {
      if (at == &first) return true;
      for (auto const& child : at->children()) {
        if (child.get() == branch) break;
        if (below(*child)) return true;
      }
    }
    return false;
  }

  template <class M>
  void mappingWithParents(M& m) const {
    hasChild<M>();
    if constexpr (requires { m.parents.paths; }) {
      if (m.parents.paths.empty()) fail("has no parents; name them: input=\"@../left @../right\"");
      entry.ends.clear();
      auto const& parents = scope.endsOf(entry);
      for (std::size_t k = 0; k < parents.size(); ++k) {
        const std::string who = text("its parent at '", m.parents.paths[k], "'");
        if (!parents[k])
          fail(text("there is no node for ", who, "; give the path from the node of the mapping"));
        const RuntimeScope<R> parent(*parents[k]);
        state<typename M::In>(parent, who, text(who, " has no MechanicalObject"));
        if (parent.stateScope().atMount) continue;
        if (!before(*parents[k], scope.node))
          fail(text("comes before ", who, ", which it follows; move its node behind that of the parent"));
        if (scope.node.state() && solver(*parents[k]) != solver(scope.node))
          fail(text("is under another ODE solver than ", who, "; put both below one solver"));
      }
    } else {
      fail("names its parents by compile-time paths, which a runtime tree has not; use LinkedParents");
    }
  }

  template <class M>
  void hasChild() const {
    if (!scope.node.state() && !scope.node.visual())
      fail("has no child: its node has neither a MechanicalObject nor a VisualModel; add one");
    if (scope.node.state())
      state<typename M::Out>(scope, "its child", "");
    else if (!std::is_same_v<typename M::Out, Vec3f>)
      fail(text("maps to ",
                data_types_name<typename M::Out>::value,
                ", but a VisualModel is of Vec3f; map to Vec3f"));
  }
  template <class M>
  void mapping() const {
    hasChild<M>();
    state<typename M::In>(
        scope.above(), "its parent", "has no parent: no node above has a MechanicalObject; add one");
    const RuntimeScope<R> parent = scope.above().stateScope();
    if (scope.node.state() && !parent.atMount && solver(parent.node) != solver(scope.node))
      fail(text("is below an ODE solver that does not move its parent at '", parent.path(), "'; put the solver above both"));
  }

  template <class C>
  void ends(C& c) const {
    if constexpr (requires { c.ends.object1; }) {
      const std::string* paths[] = {&c.ends.object1, &c.ends.object2};
      entry.ends.clear();
      for (std::size_t k = 0; k < 2; ++k) {
        if (!scope.endsOf(entry)[k])
          fail(text("object",
                    k + 1,
                    ": there is no node at '",
                    *paths[k],
                    "'; give the path from its node to that end"));
        bool above = false;
        for (auto* at = entry.ends[k]; at; at = at->parent()) above = above || at == &scope.node;
        if (!above)
          fail(text("object",
                    k + 1,
                    ": the node at '",
                    *paths[k],
                    "' is not below that of this component; put it into a node above both ends"));
        state<typename C::DataTypes>(
            RuntimeScope<R>(*entry.ends[k]),
            text("object", k + 1),
            text("object", k + 1, ": the node at '", *paths[k], "' has no MechanicalObject"));
        moved(RuntimeScope<R>(*entry.ends[k]));
      }
    } else {
      fail("joins two states by compile-time paths, which a runtime tree has not; use ends of type Linked");
    }
  }
};

}  // namespace detail

/// What checks.hpp of scene/ proves of a typed node, for one runtime node. Throws Error.
template <class R>
void runtime_checks(RuntimeScope<R> const& scope) {
  auto& node = scope.node;
  RuntimeEntry<R>* first[10]{};
  for (auto& entry : node.components()) {
    auto one = [&]<class Role>(int slot, std::string_view what) {
      if (!entry.component.template is<Role>()) return;
      bool beside = false;
      entry.component.template visit<role::OdeSolver>(
          [&](auto const& ode) { beside = stands_beside<std::decay_t<decltype(ode)>>; });
      if (beside) return;
      if (first[slot])
        return scope.collect([&] {
          detail::RuntimeChecker<R>{scope, entry}.fail(text("is the second ",
                                                            what,
                                                            " of its node, beside ",
                                                            first[slot]->component.name(),
                                                            "; keep one, or give it a node of its own"));
        });
      first[slot] = &entry;
    };
    one.template operator()<role::State>(0, "state");
    one.template operator()<role::VisualModel>(0, "state");
    one.template operator()<role::Mapping>(1, "mapping");
    one.template operator()<role::Mass>(2, "mass");
    one.template operator()<role::OdeSolver>(3, "ODE solver");
    one.template operator()<role::Topology>(4, "topology");
    one.template operator()<role::CollisionPipeline>(5, "collision pipeline");
    one.template operator()<role::BroadPhase>(6, "broad phase");
    one.template operator()<role::NarrowPhase>(7, "narrow phase");
    one.template operator()<role::Intersection>(8, "intersection method");
    one.template operator()<role::ContactManager>(9, "contact manager");
  }
  std::set<std::string_view> names;
  for (auto const& child : node.children())
    if (!names.insert(child->name).second)
      scope.collect(
          [&] { throw Error(scope.path(), text("has two children named '", child->name, "'; rename one")); });
  for (auto& entry : node.components())
    scope.collect([&] { entry.component.template visit<AnyRole>(detail::RuntimeChecker<R>{scope, entry}); });
}

}  // namespace sinew
