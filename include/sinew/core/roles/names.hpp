// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <type_traits>

namespace sinew {

namespace detail {
// In a class derived from this one and from a component, a name that the component has, too, is ambiguous.
struct AllNames {
#define SINEW_NAME(name, lower, underscored) int name, lower, underscored;
#define SINEW_OTHER_NAME(other, name) int other;
#define SINEW_SHORT_NAME(name) int name;
#include <sinew/core/roles/names.def>
};
template <class C>
struct BesideAllNames : C, AllNames {};
}  // namespace detail

/// Whether a component has a member of this name, be it a value, a function, or a template with whatever
/// arguments: named::addForce<C>. Of a final class nothing is known, and it is false.
namespace named {
#define SINEW_SHORT_NAME(name) \
  template <class C>           \
  inline constexpr bool name = !std::is_final_v<C> && !requires { &detail::BesideAllNames<C>::name; };
#define SINEW_NAME(name, lower, underscored) \
  SINEW_SHORT_NAME(name)                     \
  SINEW_SHORT_NAME(lower)                    \
  SINEW_SHORT_NAME(underscored)
#define SINEW_OTHER_NAME(other, name) SINEW_SHORT_NAME(other)
#include <sinew/core/roles/names.def>
}  // namespace named
/// The same, where a name has to be there: given the benefit of the doubt.
template <class C>
constexpr bool may_have(bool named) {
  return named || std::is_final_v<C>;
}

/// Whether a component has no name in another spelling alone.
template <class C>
inline constexpr bool spelled_right = true
#define SINEW_NAME(name, lower, underscored) &&(named::name<C> || !(named::lower<C> || named::underscored<C>))
#define SINEW_OTHER_NAME(other, name) &&(named::name<C> || !named::other<C>)
#define SINEW_SHORT_NAME(name)
#include <sinew/core/roles/names.def>
    ;
/// Says which.
template <class C>
struct Misspelt {
#define SINEW_NAME(name, lower, underscored)                                                               \
  static_assert(named::name<C> || !named::lower<C>,                                                        \
                "Sinew: a component has '" #lower "', which nothing looks for; its name is '" #name "'."); \
  static_assert(named::name<C> || !named::underscored<C>,                                                  \
                "Sinew: a component has '" #underscored "', which nothing looks for; its name is '" #name  \
                "'.");
#define SINEW_OTHER_NAME(other, name)               \
  static_assert(named::name<C> || !named::other<C>, \
                "Sinew: a component has '" #other "', which nothing looks for; its name is '" #name "'.");
#define SINEW_SHORT_NAME(name)
#include <sinew/core/roles/names.def>
};

}  // namespace sinew
