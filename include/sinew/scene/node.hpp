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
/// Stands for all that are of a fluid and meet bodies, or are their boundary particles.
struct OfFluids;
/// Stands for all that are fluids on grids and meet solids, or are the surfaces of these.
struct OfImmersion;
/// Stands for all components that have a reset(), whatever their roles.
struct WithReset;
/// Stands for all before whose steps points go and come, whatever their roles.
struct PointsComing;
template <class C, class... Roles>
inline constexpr bool has_any_role =
    ((std::is_same_v<typename C::Role, Roles> || std::is_same_v<Roles, AnyRole> ||
      (std::is_same_v<Roles, BeforeStep> && ActsBeforeStep<C>) ||
      (std::is_same_v<Roles, OfFluids> && (MeetsBoundaries<C> || BoundsFluids<C>)) ||
      (std::is_same_v<Roles, OfImmersion> && (MeetsBodies<C> || ImmersesBody<C>)) ||
      (std::is_same_v<Roles, WithReset> && Resettable<C>) ||
      (std::is_same_v<Roles, PointsComing> && ChangesPoints<C>)) ||
     ...);

/// Whether there may be a component with one of the roles in a subtree; runtime nodes may hold any.
template <class N, class... Roles>
constexpr bool holds() {
  if constexpr (requires { N::template holds<Roles...>; })
    return N::template holds<Roles...>;
  else
    return true;
}

/// How many components have a role in a subtree, without those of runtime nodes.
template <class N, class R>
constexpr int count_below() {
  if constexpr (requires { N::template countBelow<R>; })
    return N::template countBelow<R>;
  else
    return 0;
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
  }(std::make_index_sequence<true_at<Conditions...>.size()>{});
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
  template <class R>
  static constexpr int countBelow = (count<R> + ... + sinew::count_below<Ns, R>());
  /// How many are of class C.
  template <class C>
  static constexpr int countOfClass = (0 + ... + int(std::is_same_v<Cs, C>));
  /// How messages name a component: by its class, and by its place among those of its class in this node,
  /// where there are several, as in "StiffSpringForceField<Vec3d> (2 of 3)".
  template <class C>
  std::string labelOf([[maybe_unused]] C const& c) const {
    if constexpr (countOfClass<C> > 1) {
      int seen = 0, place = 0;
      auto look = [&]<class Other>(Other const& other) {
        if constexpr (std::is_same_v<Other, C>)
          if (++seen; &other == &c) place = seen;
      };
      hana::unpack(components, [&](auto const&... all) { (look(all), ...); });
      return text(component_name<C>(), " (", place, " of ", seen, ')');
    } else {
      return component_name<C>();
    }
  }
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
    constexpr int i = childIndex(Child.view());
    static_assert(i >= 0, "Sinew: this node has no child of that name.");
    if constexpr (i >= 0)
      return hana::at_c<std::size_t(i)>(children);
    else
      return *this;
  }
  static constexpr bool childNamesDiffer() {
    int i = 0;
    return ((childIndex(Ns::name.view()) == i++) && ...);
  }

  /// f(component, args...) for those with one of the roles of a RoleVisitor, in their order.
  template <class... Roles, class F, class... Args>
  void forEachComponent(RoleVisitor<F, Roles...> const& visitor, Args const&... args) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visitor.f(hana::at_c<I>(components), args...), ...);
    }(which<Roles...>);
  }

  template <class R>
  auto& first() {
    static_assert(count<R> != 0, "Sinew: this node has no component of the role asked for.");
    return firstOf<R>(*this);
  }
  template <class R>
  auto const& first() const {
    static_assert(count<R> != 0, "Sinew: this node has no component of the role asked for.");
    return firstOf<R>(*this);
  }

  /// The state, visual model, or component of class C of this node.
  auto& state() {
    static_assert(count<role::State> != 0,
                  "Sinew: this node has no state; ask the node of its MechanicalObject.");
    return firstOf<role::State>(*this);
  }
  auto const& state() const {
    static_assert(count<role::State> != 0,
                  "Sinew: this node has no state; ask the node of its MechanicalObject.");
    return firstOf<role::State>(*this);
  }
  auto& visual() {
    static_assert(count<role::VisualModel> != 0,
                  "Sinew: this node has no VisualModel; ask the node that has it.");
    return firstOf<role::VisualModel>(*this);
  }
  auto const& visual() const {
    static_assert(count<role::VisualModel> != 0,
                  "Sinew: this node has no VisualModel; ask the node that has it.");
    return firstOf<role::VisualModel>(*this);
  }
  template <class C>
  auto& get() {
    constexpr int i = [] {
      int j = 0, found = -1;
      ((std::is_same_v<Cs, C> && found < 0 ? void(found = j) : void(), ++j), ...);
      return found;
    }();
    static_assert(i >= 0,
                  "Sinew: this node has no component of the class asked for; compare it with the node<>() "
                  "that made the scene.");
    if constexpr (i >= 0)
      return hana::at_c<std::size_t(i)>(components);
    else
      return *this;
  }

 private:
  template <class R, class Self>
  static auto& firstOf(Self& self) {
    if constexpr (indexOf<R> >= 0)
      return hana::at_c<std::size_t(indexOf<R>)>(self.components);
    else
      return self;
  }
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
  static_assert(((is_node<Parts> || std::is_class_v<Parts>)&&...),
                "Sinew: node<\"name\">(...) takes components and child nodes. One argument is neither.");
  static_assert(((is_node<Parts> || !std::is_class_v<Parts> || NamesRole<Parts>)&&...),
                "Sinew: a component has no Role; write 'using Role = role::ForceField;', or another role of "
                "core/roles.");
  static_assert(((is_node<Parts> || !NamesRole<Parts> || HasKnownRole<Parts>)&&...),
                "Sinew: the Role of a component is none of those that there are; write 'using Role = "
                "role::ForceField;', or another role of core/roles.");
  static_assert(((is_node<Parts> || !NamesRole<Parts> || HasClassName<Parts>)&&...),
                "Sinew: a component has no className; write 'static constexpr std::string_view className = "
                "\"MyForce\";'.");
  static_assert(((is_node<Parts> || !NamesRole<Parts> || HasFields<Parts>)&&...),
                "Sinew: a component has no fields(); write 'static constexpr auto fields() { return "
                "field_list(field(\"stiffness\", &MyForce::stiffness, \"N/m\", \"of a spring\")); }'.");
  static_assert(((is_node<Parts> || !HasFields<Parts> || HasConstantFields<Parts>)&&...),
                "Sinew: fields() of a component is no constant; write 'static constexpr auto fields()'.");
  static_assert(((is_node<Parts> || !HasConstantFields<Parts> || ListsOwnFields<Parts>)&&...),
                "Sinew: fields() of a component lists a member of another class; list its own.");
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
/// What a name in the wrong place comes to.
template <std::size_t N, class... Parts>
auto node(char const (&)[N], Parts...) {
  static_assert(N == 0,
                "Sinew: the name of a node is a part of its type; write node<\"root\">(...) instead of "
                "node(\"root\", ...).");
  return Node<Named<"root">, hana::tuple<>, hana::tuple<>>{};
}

}  // namespace sinew
