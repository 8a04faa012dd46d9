// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/value_numbers.hpp>
#include <sinew/scene/checks.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace sinew {

// What follows while a scene runs. A link takes a value when that has other bits than what was taken last. An
// engine is evaluated again when a link into it has taken one, once, before what it makes is looked at. What
// is mapped from a state follows it at once.

/// Throws Error where a value of another number of numbers would take the place of one whose number stays:
/// that of points.
inline void check_count_stays(std::string_view where, std::string_view value, std::string_view from,
                              std::size_t wanted, std::size_t found) {
  if (wanted != found)
    throw Error(
        where,
        text(value,
             " has ",
             found,
             " numbers and would have ",
             wanted,
             " now, from ",
             from,
             "; a body keeps its number of points while the scene runs: let the engine make as many at "
             "all times"));
}

/// f(where) of a component, where `where` is only known when it has to be: a step makes no names.
template <class C, class S, class F>
void name_if_wrong(C& c, S const& scope, F&& f) {
  try {
    f(std::string_view());
  } catch (Error const&) {
    scope.located(c, [&] { f(scope.path()); });
    throw;
  }
}

/// A component has another value: it makes what it needs of it. Says whether it is a state, from which others
/// are mapped.
template <class C, class S>
bool take_values([[maybe_unused]] C& c, [[maybe_unused]] S const& scope) {
  if constexpr (!HasRole<C, role::State> && !HasRole<C, role::Engine>)
    name_if_wrong(c, scope, [&](std::string_view where) {
      check_fields(c, where);
      if constexpr (TakesValues<C>) {
        std::size_t points = 0;
        if constexpr (ActsOnState<C>) points = scope.template state<typename C::DataTypes>().size();
        c.takeValues(where, points);
      }
    });
  return HasRole<C, role::State>;
}
/// An engine makes what it makes of other values.
template <class C, class S>
void evaluate_engine(C& c, S const& scope) {
  name_if_wrong(c, scope, [&](std::string_view where) { c.update(where); });
}

/// The values that follow others in a scene, whose root is `root`.
template <class RootScope>
struct LiveEngines {
  RootScope const& root;
  double time;

  /// After a step, or, as the `first`, after init, reset, or a change of the scene. Throws Error where an
  /// engine has no result, or a component cannot have a value: what is behind it is as it was then.
  void update(bool first) const {
    if constexpr (count_below<typename RootScope::NodeType, role::DataLink>() > 0) updateLinks(root, first);
    if constexpr (holds<typename RootScope::NodeType, role::DataLink>()) updateAt(root, first);
  }

 private:
  // runtime nodes know their links, by names
  template <class S>
  void updateAt(S const& scope, bool first) const {
    const auto follow = [this] { propagate(); };
    if constexpr (requires { scope.updateLive(first, follow); }) {
      scope.updateLive(first, follow);
    } else {
      scope.template forEachChild<NoRole>([&](auto const& child) { updateAt(child, first); });
    }
  }

  template <class S>
  void updateLinks(S const& scope, bool first) const {
    // of a copy they are elsewhere
    traverse(scope, on<role::DataLink>([&](auto& link, auto const& at) { findEnds(link, at); }));
    if (first) traverse(scope, on<role::DataLink>([&](auto& link, auto const& at) { begin(link, at); }));
    traverse(scope, on<role::DataLink>([&](auto& link, auto const& at) {
               look(link, at);
               take(link, at);
             }));
    traverse(scope, on<role::DataLink>([&](auto& link, auto const& at) {
               using To = typename std::decay_t<decltype(link)>::To;
               at.template descend<To::path>(
                   [&](auto const& to) { evaluate(to.node.template get<typename To::Class>(), to); });
             }));
  }
  template <class Link, class S>
  void findEnds(Link& link, S const& at) const {
    using From = typename Link::From;
    using To = typename Link::To;
    static_assert(
        !std::is_same_v<checks::AtPath<S, From::path>, NoScope> &&
            !std::is_same_v<checks::AtPath<S, To::path>, NoScope>,
        "Sinew: a data link names a node that is not there. Paths are names joined by '/', from the "
        "node of the link on; look for a misspelt name.");
    at.template descend<From::path>(
        [&](auto const& from) { link.source = &from.node.template get<typename From::Class>(); });
    at.template descend<To::path>(
        [&](auto const& to) { link.target = &to.node.template get<typename To::Class>(); });
  }
  template <class Link, class S>
  void begin(Link& link, S const& at) const {
    using To = typename Link::To;
    link.pending = HasRole<typename To::Class, role::Engine>;
    at.template descend<To::path>([&](auto const& to) {
      to_numbers(to.node.template get<typename To::Class>().*To::member, link.numbers);
    });
    // links that were looked at before this one
    bool found = false, out = false;
    traverse(root, on<role::DataLink>([&](auto& other, auto const&) {
               found = found || static_cast<void const*>(&other) == &link;
               out = out || other.source == link.target;
               if (found || !out || !HasRole<typename To::Class, role::Engine>) return;
               throw Error(at.path(),
                           text("a data link leads into ",
                                component_name<typename To::Class>(),
                                " behind one that leads out of it; put it before that, or break the circle"));
             }));
  }
  template <class Link, class S>
  void look(Link& link, S const& at) const {
    using From = typename Link::From;
    at.template descend<From::path>([&](auto const& from) {
      auto& source = from.node.template get<typename From::Class>();
      evaluate(source, from);
      to_numbers(source.*From::member, link.next);
    });
  }
  template <class Link, class S>
  void take(Link& link, S const& at) const {
    if (same_bits(link.numbers, link.next)) return;
    using To = typename Link::To;
    at.template descend<To::path>([&](auto const& to) {
      using C = typename To::Class;
      auto& target = to.node.template get<C>();
      if constexpr (HasRole<C, role::State> || HasRole<C, role::VisualModel>) {
        if (link.numbers.size() != link.next.size())
          check_count_stays(text(to.path(), ": ", component_name<C>()),
                            "a value that follows another",
                            component_name<typename Link::From::Class>(),
                            link.next.size(),
                            link.numbers.size());
      }
      if (!from_numbers(link.next, target.*To::member))
        throw Error(text(to.path(), ": ", component_name<C>()),
                    text("a data link has ", link.next.size(), " numbers, which make no value of its field"));
      std::swap(link.numbers, link.next);
      if constexpr (HasRole<C, role::Engine>)
        link.pending = true;
      else if constexpr (!HasRole<C, role::VisualModel>)
        if (take_values(target, to)) propagate();
    });
  }
  // an engine is brought up to date
  template <class C, class S>
  void evaluate(C& c, S const& scope) const {
    if constexpr (HasRole<C, role::Engine>) {
      bool pending = false;
      auto each = [&](auto&& f) {
        traverse(root, on<role::DataLink>([&](auto& link, auto const&) {
                   if (link.target == &c) f(link);
                 }));
      };
      each([&](auto& link) { pending = pending || link.pending; });
      if (!pending) return;
      evaluate_engine(c, scope);
      each([&](auto& link) { link.pending = false; });
    }
  }

  // what is mapped from a state that has moved
  void propagate() const {
    MechanicalOperations(root, time).propagate(vec_id::position, vec_id::velocity);
    with_first<role::AnimationLoop>(root, [&](auto const&) {
      traverse(root, on<role::State>([](auto& s, auto const&) {
                 if constexpr (requires { s.freePosition; }) s.freePosition = s.position;
               }));
    });
  }
};

}  // namespace sinew
