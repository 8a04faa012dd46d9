// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/from_typed.hpp>
#include <sinew/runtime/precompiled.hpp>

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace sinew {

/// A node of a RegistryScene, asked as the typed node N is.
template <class N>
struct RegistryNode {
  RuntimeNode<Standard>& node;

  operator RuntimeNode<Standard>&() const { return node; }
  /// What the registry has for a component class of the typed tree.
  template <class C>
  static auto registered() {
    if constexpr (requires { C::Ends::first; })
      return std::type_identity<typename C::template WithEnds<Linked>>{};
    else if constexpr (requires { C::Parents::list(); })
      return std::type_identity<typename C::template WithParents<LinkedParents>>{};
    else
      return std::type_identity<C>{};
  }
  /// The component that stands where the first of class C does in the typed node.
  template <class C>
  auto& get() const {
    constexpr auto place = []<class... Cs>(hana::tuple<Cs...> const*) {
      constexpr bool same[] = {std::is_same_v<C, Cs>...};
      return std::size_t(std::find(std::begin(same), std::end(same), true) - std::begin(same));
    }(static_cast<decltype(N::components)*>(nullptr));
    return *node.components()[place].component.template getIf<typename decltype(registered<C>())::type>();
  }
  template <class Role>
  auto& first() const {
    return get<std::decay_t<decltype(std::declval<N&>().template first<Role>())>>();
  }
  auto& state() const { return first<role::State>(); }
  auto& visual() const { return first<role::VisualModel>(); }
};

/// A scene that is written as a typed one and runs as the runtime tree of the standard registry, whose steps
/// are compiled once: for tests that have another subject than types. Both have the same bits, which
/// tests/runtime/same_bits_*.cpp show.
template <class Root>
class RegistryScene : public StandardSimulation {
 public:
  explicit RegistryScene(Root const& typed) : StandardSimulation(to_runtime<Standard>(typed)) {}

  template <FixedString Path>
  auto at() {
    using N = std::decay_t<decltype(detail::node_at<Path>(std::declval<Root&>()))>;
    if constexpr (holds<N, role::VisualModel>()) updateVisual();
    return RegistryNode<N>{*StandardSimulation::root().find_node(Path.view())};
  }
  RegistryNode<Root> root() { return {StandardSimulation::root()}; }
};

}  // namespace sinew
