// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/core/value_numbers.hpp>

#include <type_traits>
#include <vector>

namespace sinew {

namespace detail {
template <class A, class B>
constexpr bool is_member(A a, B b) {
  if constexpr (std::is_same_v<A, B>)
    return a == b;
  else
    return false;
}
template <class C, class T>
C owner_of(T C::*);
template <class C, auto Member>
inline constexpr bool takes_while_running = HasRole<C, role::Engine> || HasRole<C, role::VisualModel> ||
                                            boost::hana::unpack(fields_of_class<C>, [](auto const&... fd) {
                                              return ((fd.live && is_member(fd.member, Member)) || ...);
                                            });
}  // namespace detail

/// A value in a typed scene: a member of the component of a class in the node at a path, from that of the
/// link on. Of several components of the class in the node it is the first.
template <FixedString Path, auto Member, class C = decltype(detail::owner_of(Member))>
struct At {
  static constexpr auto path = Path;
  static constexpr auto member = Member;
  using Class = C;
};

/// In a typed scene: one value follows another after init, reset and each step. Where it is an input of an
/// engine that changes, this is evaluated again before a link behind takes what it makes; where it is one of
/// another component, that acts with it from the next step on:
///
///   node<"root">(..., node<"body">(MechanicalObject<Vec3d>{...}, AverageCoord<Vec3d>{}),
///                data_link(At<"body", &MechanicalObject<Vec3d>::position>{},
///                          At<"body", &AverageCoord<Vec3d>::position>{}))
///
/// Links act in their order, from the root on: one that leads into an engine stands before those that lead
/// out of it. Both values are numbers, or lists of numbers, points or frames, in the same order. A state
/// keeps its number of points. In scene files a link is an attribute: position="@body.position".
template <class FromValue, class ToValue>
struct DataLink {
  using Role = role::DataLink;
  using From = FromValue;
  using To = ToValue;
  static constexpr std::string_view className = "DataLink";

  static constexpr auto fields() { return field_list(); }

  // after init
  std::vector<double> numbers{}, next{};            // what was taken last, and what is looked at
  void const *source = nullptr, *target = nullptr;  // components
  bool pending = false;                             // of one into an engine: it has to be evaluated

  static_assert(
      detail::takes_while_running<typename To::Class, To::member>,
      "Sinew: a data link leads to a field that takes no other value while the scene runs; the reference "
      "of components says which do.");
  static_assert(OfNumbers<std::decay_t<decltype(std::declval<typename From::Class&>().*From::member)>> &&
                    OfNumbers<std::decay_t<decltype(std::declval<typename To::Class&>().*To::member)>>,
                "Sinew: a data link joins values that are numbers, or lists of numbers, points or frames.");
};

/// The link from one value to another.
template <class From, class To>
DataLink<From, To> data_link(From, To) {
  return {};
}

}  // namespace sinew
