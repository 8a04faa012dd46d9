// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/registry.hpp>
#include <sinew/scene/checks.hpp>

#include <type_traits>

namespace sinew::checks {

/// A class of a registry that is no component.
template <class C>
struct NoComponent {
  static_assert(
      NamesRole<C>,
      "Sinew: a class of a registry has no Role; write 'using Role = role::ForceField;', or another "
      "role of core/roles.");
  static_assert(!NamesRole<C> || HasKnownRole<C>,
                "Sinew: the Role of a class of a registry is none of those that there are; write 'using Role "
                "= role::ForceField;', or another role of core/roles.");
  static_assert(HasClassName<C>,
                "Sinew: a class of a registry has no className, by which scene files know it; write 'static "
                "constexpr std::string_view className = \"MyForce\";'.");
  static_assert(
      HasFields<C>,
      "Sinew: a class of a registry has no fields(); write 'static constexpr auto fields() { return "
      "field_list(field(\"stiffness\", &MyForce::stiffness, \"N/m\", \"of a spring\")); }'.");
  static_assert(
      !HasFields<C> || HasConstantFields<C>,
      "Sinew: fields() of a class of a registry is no constant; write 'static constexpr auto fields()'.");
  static_assert(!HasConstantFields<C> || ListsOwnFields<C>,
                "Sinew: fields() of a class of a registry lists a member of another class; list its own.");
};

/// A registry says so whose classes are all known to keep their promises: to look at those of Standard would
/// take a tenth of the time of its header.
template <class R>
concept Proved = requires { requires R::proved; };

// what is wrong with a class of a registry by itself
template <class C>
constexpr auto promised(std::type_identity<C>) {
  if constexpr (!Component<C>)
    return std::type_identity<NoComponent<C>>{};
  else if constexpr (!keeps_promise<C>)
    return broken_promise<C>();
  else
    return std::type_identity<Right>{};
}
// the same, beside a linear solver that assembles a matrix
template <class C>
constexpr auto assembled(std::type_identity<C>) {
  using Promised = Promise<typename C::Role>;
  if constexpr (!Promised::template assembled<C>)
    return std::type_identity<typename Promised::template NotAssembled<C>>{};
  else
    return std::type_identity<Right>{};
}
// of the classes that are not proved, the first that is wrong
template <bool Assembled, class... Entries>
constexpr auto listed(std::type_identity<Registry<Entries...>>);
template <bool Assembled, class C>
constexpr auto listed(std::type_identity<C> c) {
  if constexpr (Proved<C>)
    return std::type_identity<Right>{};
  else if constexpr (requires { typename C::Listed; })
    return checks::listed<Assembled>(std::type_identity<typename C::Listed>{});
  else if constexpr (Assembled)
    return checks::assembled(c);
  else
    return checks::promised(c);
}
template <bool Assembled, class... Entries>
constexpr auto listed(std::type_identity<Registry<Entries...>>) {
  return checks::worst(checks::listed<Assembled>(std::type_identity<Entries>{})...);
}

template <class C>
constexpr bool keeps_matrix() {
  if constexpr (HasRole<C, role::LinearSolver>)
    return needs_pattern<C>;
  else
    return false;
}
template <class... Cs>
constexpr bool any_keeps_matrix(sinew::detail::TypeList<Cs...>) {
  for (const bool one : {keeps_matrix<Cs>()..., false})
    if (one) return true;
  return false;
}
template <class R>
constexpr auto registry() {
  constexpr auto first = checks::listed<false>(std::type_identity<R>{});
  if constexpr (Proved<R> || !right<std::remove_const_t<decltype(first)>>)
    return first;
  else if constexpr (any_keeps_matrix(typename sinew::detail::Flat<R>::type{}))
    return checks::listed<true>(std::type_identity<R>{});
  else
    return first;
}

/// Right, or the type that says what is wrong with a class of a registry (runtime/node.hpp takes it as
/// Simulation does with the verdict on a typed scene).
template <class R>
using RegistryVerdict = typename decltype(checks::registry<R>())::type;

}  // namespace sinew::checks
