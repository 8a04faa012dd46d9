// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace sinew {

/// States whose points go and come while the scene runs: those that a ParticleSource or a ParticleSink acts
/// on. What acts on them follows (FollowsPoints); what could not, is refused at init.
template <class RootScope>
struct ChangingPoints {
  RootScope const& root;
  static constexpr bool any = holds<typename RootScope::NodeType, PointsComing>();

  /// Before states are initialised: how many points each may have. Throws Error where one of what is in the
  /// scene cannot follow.
  void begin() const {
    if constexpr (any) {
      bool changing = false;
      traverse(root, on<role::State>([](auto& s, auto const&) { s.capacity = 0; }));
      traverse(root, on<PointsComing>([&](auto& c, auto const& scope) {
                 changing = true;
                 scope.located(c, [&] {
                   auto& s = stateOf(c, scope);
                   s.capacity = std::max(s.capacity, std::size_t(1));
                   if constexpr (requires { c.capacity; })
                     s.capacity = std::max(s.capacity, std::size_t(c.capacity));
                 });
               }));
      if (changing)
        traverse(root, on<AnyRole>([this](auto& c, auto const& scope) {
                   scope.located(c, [&] { check(c, scope); });
                 }));
      root.raise();
    }
  }

  /// When components are initialised: makes room.
  void init() const {
    if constexpr (any) {
      traverse(root, on<role::State>([](auto& s, auto const&) {
                 if (s.capacity > 0) {
                   s.reserveCapacity();
                 } else if (s.resetPosition.size() != s.size()) {
                   // its points no longer come and go
                   s.resetPosition = s.position;
                   s.resetVelocity = s.velocity;
                 }
               }));
      eachFollower([](auto& c, auto& s) {
        c.followPoints(Renumbering{}, std::max(s.size(), s.capacity));
        c.followPoints(Renumbering{}, s.size());
      });
      eachFollowingSolver([](auto& ode, auto& s) {
        ode.followPoints(Renumbering{}, s.capacity);
        ode.followPoints(Renumbering{}, s.size());
      });
    }
  }

  /// Before a step.
  void change(StepAhead const& ahead) const {
    if constexpr (any) {
      bool changing = false;
      traverse(root, on<PointsComing>([&](auto&, auto const&) { changing = true; }));
      if (!changing) return;
      eachState([](auto& s) { s.pointChange.begin(s.size()); });
      traverse(root, on<PointsComing>([&](auto& c, auto const& scope) {
                 auto& s = stateOf(c, scope);
                 c.changePoints(ahead, s.position, s.pointChange);
               }));
      traverse(root, on<PointsComing>([&](auto& c, auto const&) {
                 if constexpr (requires { c.acceptPoints(); }) c.acceptPoints();
               }));
      eachState([](auto& s) {
        if (!s.pointChange.changes()) return;
        s.pointChange.renumber();
        s.changePoints();
      });
      eachFollower([](auto& c, auto& s) {
        if (s.pointChange.changes()) c.followPoints(s.pointChange.points, s.size());
      });
      eachFollowingSolver([](auto& ode, auto& s) {
        if (s.pointChange.changes()) ode.followPoints(s.pointChange.points, s.size());
      });
      // what a solver remembers of the last step is not that of other points
      for_each_solver(root, [](auto& ode, auto const& scope) {
        if constexpr (requires { ode.lastEnd; })
          traverse(scope, on<role::State>([&](auto& s, auto const&) {
                     if (s.capacity > 0 && s.pointChange.changes()) ode.lastEnd = -1;
                   }));
      });
    }
  }

  /// When states are as they started.
  void reset() const {
    if constexpr (any) {
      eachFollower([](auto& c, auto& s) { c.followPoints(Renumbering{}, s.size()); });
      eachFollowingSolver([](auto& ode, auto& s) { ode.followPoints(Renumbering{}, s.size()); });
    }
  }

 private:
  template <class C, class S>
  static auto& stateOf(C&, S const& scope) {
    return scope.template state<typename std::decay_t<C>::DataTypes>();
  }
  template <class F>
  void eachState(F&& f) const {
    traverse(root, on<role::State>([&](auto& s, auto const&) {
               if (s.capacity > 0) f(s);
             }));
  }
  // f(component, state) for what acts on states whose points go and come
  template <class F>
  void eachFollower(F&& f) const {
    traverse(root, on<AnyRole>([&](auto& c, auto const& scope) {
               using C = std::decay_t<decltype(c)>;
               if constexpr (FollowsPoints<C> && !HasRole<C, role::OdeSolver>)
                 if (auto& s = stateOf(c, scope); s.capacity > 0) f(c, s);
             }));
  }

  // f(solver, state) for the solvers that have values of each point
  template <class F>
  void eachFollowingSolver(F&& f) const {
    for_each_solver(root, [&](auto& ode, auto const& scope) {
      if constexpr (FollowsPoints<std::decay_t<decltype(ode)>>)
        traverse(scope, on<role::State>([&](auto& s, auto const&) {
                   if (s.capacity > 0) f(ode, s);
                 }));
    });
  }

  // whether the points of the state at an address go and come
  bool changes(void const* state) const {
    bool found = false;
    traverse(root, on<role::State>([&](auto& s, auto const&) {
               found = found || (static_cast<void const*>(&s) == state && s.capacity > 0);
             }));
    return found;
  }
  template <class S>
  bool changesBelow(S const& scope) const {
    bool found = false;
    traverse(scope, on<role::State>([&](auto& s, auto const&) { found = found || s.capacity > 0; }));
    return found;
  }

  template <class C, class S>
  void check(C& c, S const& scope) const {
    auto refuse = [&](std::string_view why) {
      throw Error(text(scope.path(), ": ", component_name<C>()),
                  text(why, " whose points go and come while the scene runs (ParticleSource, ParticleSink)"));
    };
    if constexpr (MakesFaces<C> || HasRole<C, role::OdeSolver>) {
      // faces are made of any points, and solvers with values of each follow
    } else if constexpr (HasRole<C, role::Mapping>) {
      scope.withMapped(c, [&](auto&, auto&, auto& parent) {
        if (changes(&parent)) refuse("a mapping has an entry for each point; take it away from a state");
      });
    } else if constexpr (HasRole<C, role::AnimationLoop>) {
      refuse("constraints by multipliers are not for scenes with a state; leave the loop out of one");
    } else if constexpr (HasRole<C, role::LinearSolver>) {
      if constexpr (needs_pattern<C>)
        if (changesBelow(scope))
          refuse(
              "a matrix is made for as many points as there are at the start; take a CGLinearSolver without "
              "matrix, or an explicit solver, for a state");
    } else if constexpr (JoinsTwo<C>) {
      scope.withEnds(c, [&](auto const& a, auto const& b) {
        if (changes(a.stateAddress()) || changes(b.stateAddress()))
          refuse("it has the numbers of points; take it away from a state");
      });
    } else if constexpr ((ActsOnState<C> || ActsBeforeStep<C>)&&!FollowsPoints<C>) {
      if (changes(scope.stateAddress()))
        refuse("it has an entry for each point, or the numbers of some; take it away from a state");
    } else if constexpr (HasRole<C, role::Topology>) {
      if (changes(scope.pointsAddress())) {
        if (dimension_of(c.view()) > 0)
          refuse("it has elements; leave them out, or give it a state of its own beside one");
      }
    }
  }
};

}  // namespace sinew
