// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <array>
#include <cstddef>
#include <type_traits>

namespace sinew {

/// A list of component types, closed: what the law suites prove, and what scenes at run time may be made of.
/// A list of one's own extends another: struct Mine : Registry<Standard, MyForce<Vec3d>> {}. A class of its
/// own, as here, keeps the names short that compilers and debuggers make of it.
template <class... Entries>
struct Registry {
  using Listed = Registry;
};

namespace detail {

template <class... Cs>
struct TypeList {};

// a list in which each class stands once, and the classes that are in it, as bases
template <class Seen, class... Cs>
struct Collected {};
template <class Seen, class C>
struct Also : Seen, std::type_identity<C> {};
template <class Entry>
struct Item {};

template <class Seen, class... Cs, class C>
auto operator+(Collected<Seen, Cs...> all, Item<C>) {
  if constexpr (requires { typename C::Listed; })
    return all + Item<typename C::Listed>{};
  else if constexpr (std::is_base_of_v<std::type_identity<C>, Seen>)
    return all;
  else
    return Collected<Also<Seen, C>, Cs..., C>{};
}
template <class Seen, class... Cs, class... Entries>
auto operator+(Collected<Seen, Cs...> all, Item<Registry<Entries...>>) {
  return (all + ... + Item<Entries>{});
}
template <class Seen, class... Cs>
TypeList<Cs...> list_of(Collected<Seen, Cs...>);
struct None {};
template <class R>
struct Flat {
  using type = decltype(list_of(Collected<None>{} + Item<R>{}));
};

template <class... Cs, class F>
constexpr void for_each_type(TypeList<Cs...>, F&& f) {
  // no fold: clang nests those 256 deep at most
  [[maybe_unused]] const bool called[] = {(f.template operator()<Cs>(), true)..., true};
}
template <class... Cs>
constexpr std::size_t count_types(TypeList<Cs...>) {
  return sizeof...(Cs);
}
template <class C, class... Cs>
constexpr int index_of_type(TypeList<Cs...>) {
  constexpr bool same[] = {std::is_same_v<C, Cs>..., true};
  int i = 0;
  while (!same[i]) ++i;
  return i < int(sizeof...(Cs)) ? i : -1;
}

}  // namespace detail

/// f.operator()<C>() for each component of a registry and of those inside it.
template <class R, class F>
constexpr void for_each_registered(F&& f) {
  detail::for_each_type(typename detail::Flat<R>::type{}, f);
}
template <class R>
inline constexpr std::size_t registered_count = detail::count_types(typename detail::Flat<R>::type{});
/// Place of C in a registry; -1 where it is not in it.
template <class R, class C>
inline constexpr int registered_index = detail::index_of_type<C>(typename detail::Flat<R>::type{});

}  // namespace sinew
