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

// what is wrong with a class of a registry, or with the first one that is wrong of a list
template <class... Entries>
constexpr auto registered(std::type_identity<Registry<Entries...>>);
template <class C>
constexpr auto registered(std::type_identity<C>) {
  if constexpr (Proved<C>)
    return std::type_identity<Right>{};
  else if constexpr (requires { typename C::Listed; })
    return checks::registered(std::type_identity<typename C::Listed>{});
  else if constexpr (!Component<C>)
    return std::type_identity<NoComponent<C>>{};
  else if constexpr (!keeps_promise<C>)
    return broken_promise<C>();
  else
    return std::type_identity<Right>{};
}
template <class... Entries>
constexpr auto registered(std::type_identity<Registry<Entries...>>) {
  return checks::worst(checks::registered(std::type_identity<Entries>{})...);
}

/// Right, or the type that says what is wrong with a class of a registry (runtime/node.hpp takes it as
/// Simulation does with the verdict on a typed scene).
template <class R>
using RegistryVerdict = typename decltype(checks::registered(std::type_identity<R>{}))::type;

}  // namespace sinew::checks
