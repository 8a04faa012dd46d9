// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <array>
#include <type_traits>
#include <utility>

namespace sinew {

namespace hana = boost::hana;

/// A component: a default-constructible class with a role, a name and fields.
template <class C>
concept Component = requires {
  typename C::Role;
  { C::className } -> std::convertible_to<std::string_view>;
  C::fields();
};

/// A function of components, called for those that have one of the roles only.
template <class F, class... Roles>
struct RoleVisitor {
  F f;
};
template <class... Roles, class F>
RoleVisitor<F, Roles...> on(F f) {
  return {std::move(f)};
}
/// Stands for all roles: on<AnyRole>(f).
struct AnyRole;
/// Stands for no component: for what runtime nodes alone have to do.
struct NoRole;
/// Stands for all components that act before a step, whatever their roles.
struct BeforeStep;
/// Stands for all components that have a reset(), whatever their roles.
struct WithReset;
template <class C, class... Roles>
inline constexpr bool has_any_role = ((std::is_same_v<typename C::Role, Roles> ||
                                       std::is_same_v<Roles, AnyRole> ||
                                       (std::is_same_v<Roles, BeforeStep> && ActsBeforeStep<C>) ||
                                       (std::is_same_v<Roles, WithReset> && Resettable<C>)) ||
                                      ...);

/// Whether there may be a component with one of the roles in a subtree; runtime nodes may hold any.
template <class N, class... Roles>
constexpr bool holds() {
  if constexpr (requires { N::template holds<Roles...>; })
    return N::template holds<Roles...>;
  else
    return true;
}

namespace detail {
/// Where those of some conditions stand that are true.
template <bool... Conditions>
inline constexpr auto true_at = [] {
  std::array<std::size_t, (0 + ... + int(Conditions))> places{};
  std::size_t i = 0, found = 0;
  ((Conditions ? void(places[found++] = i) : void(), ++i), ...);
  return places;
}();
/// The same as a std::index_sequence.
template <bool... Conditions>
constexpr auto places_of() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::index_sequence<true_at<Conditions...>[I]...>{};
  }
  (std::make_index_sequence<true_at<Conditions...>.size()>{});
}
}  // namespace detail

/// What is in a node of a typed scene. Nodes that differ by their names alone share it, and with it all that
/// the compiler makes of it.
template <class Components, class Children>
struct NodeParts;

template <class... Cs, class... Ns>
struct NodeParts<hana::tuple<Cs...>, hana::tuple<Ns...>> {
  static constexpr int childCount = int(sizeof...(Ns));

  hana::tuple<Cs...> components;
  hana::tuple<Ns...> children;

  template <class... Roles>
  static constexpr bool holds = (has_any_role<Cs, Roles...> || ...) || (sinew::holds<Ns, Roles...>() || ...);

  template <std::size_t I>
  using Child = std::decay_t<decltype(hana::at_c<I>(std::declval<hana::tuple<Ns...>&>()))>;

  /// How many components have the role R, and where the first of them stands (-1: none).
  template <class R>
  static constexpr int count = (0 + ... + int(HasRole<Cs, R>));
  /// ODE solvers of the kind that stands beside the one of a node.
  static constexpr int solversBeside = (0 + ... + int(stands_beside<Cs>));
  template <class R>
  static constexpr int indexOf = [] {
    int i = 0, found = -1;
    ((HasRole<Cs, R> && found < 0 ? void(found = i) : void(), ++i), ...);
    return found;
  }();
  static constexpr int childIndex(std::string_view child) {
    int i = 0, found = -1;
    ((Ns::name.view() == child && found < 0 ? void(found = i) : void(), ++i), ...);
    return found;
  }
  /// The child of a name.
  template <FixedString Child>
  auto& child() {
    static_assert(childIndex(Child.view()) >= 0, "Sinew: this node has no child of that name.");
    return hana::at_c<std::size_t(childIndex(Child.view()))>(children);
  }
  static constexpr bool childNamesDiffer() {
    int i = 0;
    return ((childIndex(Ns::name.view()) == i++) && ...);
  }

  /// f(component, args...) for those with one of the roles of a RoleVisitor, in their order.
  template <class... Roles, class F, class... Args>
  void forEachComponent(RoleVisitor<F, Roles...> const& visitor, Args const&... args) {
    [&]<std::size_t... I>(std::index_sequence<I...>) { (visitor.f(hana::at_c<I>(components), args...), ...); }
    (which<Roles...>);
  }

  template <class R>
  auto& first() {
    return hana::at_c<std::size_t(indexOf<R>)>(components);
  }
  template <class R>
  auto const& first() const {
    return hana::at_c<std::size_t(indexOf<R>)>(components);
  }

  /// The state, visual model, or component of class C of this node.
  auto& state() { return first<role::State>(); }
  auto const& state() const { return first<role::State>(); }
  auto& visual() { return first<role::VisualModel>(); }
  auto const& visual() const { return first<role::VisualModel>(); }
  template <class C>
  C& get() {
    constexpr int i = [] {
      int j = 0, found = -1;
      ((std::is_same_v<Cs, C> && found < 0 ? void(found = j) : void(), ++j), ...);
      return found;
    }();
    static_assert(i >= 0,
                  "Sinew: this node has no component of the class asked for; compare it with the node<>() "
                  "that made the scene.");
    return hana::at_c<std::size_t(i)>(components);
  }

 private:
  template <class... Roles>
  static constexpr auto which = detail::places_of<has_any_role<Cs, Roles...>...>();
};

/// A node of a typed scene: plain data, composed by node<"name">(...).
template <class Name, class Components, class Children>
struct Node : NodeParts<Components, Children> {
  using Parts = NodeParts<Components, Children>;
  static constexpr auto name = Name::value;
};

/// What may be a child of a typed node: typed nodes, and the runtime nodes of runtime/node.hpp.
template <class T>
inline constexpr bool is_node = false;
template <class Name, class Components, class Children>
inline constexpr bool is_node<Node<Name, Components, Children>> = true;

namespace detail {
/// The node of some parts, of which these are components and those are children. Not a part of the function
/// that calls it: there the parts are temporaries, and g++ takes time by the square of what it sees of them.
template <class Name, class... Parts, std::size_t... C, std::size_t... N>
[[gnu::noinline]] auto compose([[maybe_unused]] hana::tuple<Parts...> parts, std::index_sequence<C...>,
                               std::index_sequence<N...>) {
  return Node<Name,
              hana::tuple<std::decay_t<decltype(hana::at_c<C>(parts))>...>,
              hana::tuple<std::decay_t<decltype(hana::at_c<N>(parts))>...>>{
      {{std::move(hana::at_c<C>(parts))...}, {std::move(hana::at_c<N>(parts))...}}};
}
}  // namespace detail

/// Composes a node from components and child nodes, in any order; each keeps its order among its own kind.
template <FixedString Name, class... Parts>
auto node(Parts... parts) {
  static_assert(
      ((Component<Parts> || is_node<Parts>)&&...),
      "Sinew: node<\"name\">(...) takes components and child nodes. One argument is neither: a component has "
      "a Role, a className and fields().");
  static_assert(Name.view().find('/') == std::string_view::npos && !Name.view().empty(),
                "Sinew: the name of a node is not empty and has no '/', which separates names in a path.");
  if constexpr (!((Component<Parts> || is_node<Parts>)&&...)) {
    return Node<Named<Name>, hana::tuple<>, hana::tuple<>>{};  // nothing else fails
  } else {
    return detail::compose<Named<Name>>(hana::tuple<Parts...>(std::move(parts)...),
                                        detail::places_of<!is_node<Parts>...>(),
                                        detail::places_of<is_node<Parts>...>());
  }
}

}  // namespace sinew
