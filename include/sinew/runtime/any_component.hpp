// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/ends.hpp>
#include <sinew/runtime/registry_checks.hpp>
#include <sinew/scene/node.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// What can be done with a component of whatever class in a registry, by its place in it.
struct ComponentOperations {
  void* (*make)();
  void* (*copy)(void const*);
  void (*destroy)(void*);
  std::string (*name)();
  bool (*isCalled)(std::string_view);
  void (*checkFields)(void const*, std::string_view where);
  Linked* (*ends)(void*);
  std::vector<std::string>* (*parents)(void*);
};
template <class C>
Linked* linked_ends(void* c) {
  if constexpr (HasLinkedEnds<C>)
    return &static_cast<C*>(c)->ends;
  else
    return nullptr;
}
template <class C>
std::vector<std::string>* linked_parents(void* c) {
  if constexpr (HasLinkedParents<C>)
    return &static_cast<C*>(c)->parents.paths;
  else
    return nullptr;
}
template <class C>
bool class_is_called(std::string_view name) {
  if constexpr (requires { C::aliases; })
    if (has_name(C::aliases, name)) return true;
  return name == C::className;
}
template <class C>
constexpr ComponentOperations component_operations() {
  return {[]() -> void* { return new C{}; },
          [](void const* c) -> void* { return new C(*static_cast<C const*>(c)); },
          [](void* c) { delete static_cast<C*>(c); },
          [] { return component_name<C>(); },
          &class_is_called<C>,
          [](void const* c, std::string_view where) { check_fields(*static_cast<C const*>(c), where); },
          &linked_ends<C>,
          &linked_parents<C>};
}
template <class... Cs>
constexpr auto all_component_operations(TypeList<Cs...>) {
  // the type in words: the compiler would deduce it by a fold, which clang nests 256 deep at most
  return std::array<ComponentOperations, sizeof...(Cs)>{component_operations<Cs>()...};
}

// the class at a place of a list, by the base that has its number
template <std::size_t I, class C>
struct Placed {};
template <class Numbers, class... Cs>
struct Places;
template <std::size_t... I, class... Cs>
struct Places<std::index_sequence<I...>, Cs...> : Placed<I, Cs>... {};
template <std::size_t I, class C>
std::type_identity<C> placed_at(Placed<I, C> const*);

/// The classes of a list with one of the roles, and the place of each class of the list among them (-1:
/// none). Found once for each set of roles: what is visited is instantiated for these classes alone.
template <class List, class... Roles>
struct WithRole;
template <class... Cs, class... Roles>
struct WithRole<TypeList<Cs...>, Roles...> {
  static constexpr std::array<bool, sizeof...(Cs)> has{has_any_role<Cs, Roles...>...};
  static constexpr std::size_t count = std::size_t(std::count(has.begin(), has.end(), true));
  static constexpr auto places = [] {
    std::array<short, sizeof...(Cs)> all{};
    short next = 0;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = has[i] ? next++ : short(-1);
    return all;
  }();
  static constexpr auto numbers = [] {
    std::array<std::size_t, count> all{};
    for (std::size_t i = 0, next = 0; i < has.size(); ++i)
      if (has[i]) all[next++] = i;
    return all;
  }();
  using All = Places<std::index_sequence_for<Cs...>, Cs...>;
  template <std::size_t... K>
  static auto select(std::index_sequence<K...>)
      -> TypeList<typename decltype(placed_at<numbers[K]>(static_cast<All const*>(nullptr)))::type...>;
  using Classes = decltype(select(std::make_index_sequence<count>{}));
};

template <class C, class F>
void call_with(void* component, void* f) {
  (*static_cast<F*>(f))(*static_cast<C*>(component));
}
template <class F, class... Cs>
constexpr auto call_table(TypeList<Cs...>) {
  return std::array<void (*)(void*, void*), sizeof...(Cs)>{&call_with<Cs, F>...};
}

/// What a visitor does with components of the classes that it visits: `places` of classes in `calls`.
struct VisitTable {
  short const* places;
  void (*const* calls)(void* component, void* f);
};

}  // namespace detail

/// A component of one of the classes of a registry R: a closed variant, whose value keeps its address.
template <class R>
class AnyComponent {
 public:
  /// Where a class of the registry is wrong, RuntimeNode says so, and nothing is made of any.
  using Verdict = checks::RegistryVerdict<R>;
  using List = std::conditional_t<std::is_same_v<Verdict, checks::Right>, typename detail::Flat<R>::type,
                                  detail::TypeList<>>;

  template <class C>
  static AnyComponent of(C component) {
    static_assert(registered_index<R, C> >= 0,
                  "Sinew: a component is not in the registry of the runtime tree. Add it: Registry<Standard, "
                  "MyForce<Vec3d>>.");
    return {registered_index<R, C>, new C(std::move(component))};
  }
  /// A default one of the class at a place of the registry.
  static AnyComponent make(int type) { return {type, operations(type).make()}; }

  AnyComponent(AnyComponent const& other)
      : type_(other.type_), value_(operations(other.type_).copy(other.value_)) {}
  AnyComponent(AnyComponent&& other) noexcept
      : type_(other.type_), value_(std::exchange(other.value_, nullptr)) {}
  AnyComponent& operator=(AnyComponent other) noexcept {
    std::swap(type_, other.type_);
    std::swap(value_, other.value_);
    return *this;
  }
  ~AnyComponent() {
    if (value_) operations(type_).destroy(value_);
  }

  int type() const { return type_; }
  void* address() const { return value_; }
  /// "UniformMass<Vec3d>".
  std::string name() const { return operations(type_).name(); }
  /// Whether that is a name of its class, without DataTypes.
  bool isCalled(std::string_view word) const { return operations(type_).isCalled(word); }

  /// Throws Error unless every field is finite and in its declared range.
  void checkFields(std::string_view where) const { operations(type_).checkFields(value_, where); }

  /// The paths of the two states that it joins; null where it joins none.
  Linked* ends() const { return operations(type_).ends(value_); }
  /// The paths of the parents of a mapping with several; null of all others.
  std::vector<std::string>* parents() const { return operations(type_).parents(value_); }

  template <class C>
  C* getIf() const {
    return type_ == registered_index<R, C> ? static_cast<C*>(value_) : nullptr;
  }
  /// f(component), if its class has one of the roles; says whether.
  template <class... Roles, class F>
  bool visit(F&& f) const {
    return visit(visits<Roles...>(f), address_of(f));
  }
  bool visit(detail::VisitTable table, void* f) const {
    const int place = table.places[index()];
    if (place >= 0) table.calls[std::size_t(place)](value_, f);
    return place >= 0;
  }
  bool isVisited(detail::VisitTable table) const { return table.places[index()] >= 0; }
  /// How f visits components; it does so by its address.
  template <class... Roles, class F>
  static detail::VisitTable visits(F&) {
    using Visited = detail::WithRole<List, Roles...>;
    static constexpr auto calls = detail::call_table<F>(typename Visited::Classes{});
    return {Visited::places.data(), calls.data()};
  }
  template <class F>
  static void* address_of(F& f) {
    return const_cast<void*>(static_cast<void const*>(std::addressof(f)));
  }
  template <class... Roles>
  bool is() const {
    return detail::WithRole<List, Roles...>::places[index()] >= 0;
  }

 private:
  int type_;
  void* value_;
  // out of the class, so that a program which links sinew::standard has no code for it
  static detail::ComponentOperations const& operations(int type);

  AnyComponent(int type, void* value) : type_(type), value_(value) {}
  std::size_t index() const { return std::size_t(type_); }
};

template <class R>
detail::ComponentOperations const& AnyComponent<R>::operations(int type) {
  static constexpr auto all = detail::all_component_operations(List{});
  return all[std::size_t(type)];
}

namespace detail {
template <class D>
std::type_identity<void> state_over(TypeList<>) {
  return {};
}
template <class D, class First, class... Rest>
auto state_over(TypeList<First, Rest...>) {
  if constexpr (std::is_same_v<typename First::DataTypes, D>)
    return std::type_identity<First>{};
  else
    return state_over<D>(TypeList<Rest...>{});
}
}  // namespace detail

/// The class of states over D in a registry; void where it has none.
template <class R, class D>
struct StateOf {
  using States = typename detail::WithRole<typename detail::Flat<R>::type, role::State>::Classes;
  using type = typename decltype(detail::state_over<D>(States{}))::type;
};

}  // namespace sinew
