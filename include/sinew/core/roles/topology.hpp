// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// Elements over the points of the state of its node. The shortest:
//
//   /// Edges from each point to the next.
//   struct Chain {
//     using Role = role::Topology;
//     static constexpr std::string_view className = "Chain";
//     static constexpr auto fields() { return field_list(); }
//
//     std::vector<Edge> edges{};
//
//     template <class D>
//     void init(InitContext<D> const& context) {
//       for (int i = 1; i < int(context.rest.size()); ++i) edges.push_back({i - 1, i});
//     }
//     TopologyView view() const { return {.edges = edges}; }
//   };

template <class C>
concept HasView = requires(C const c) {
  { c.view() } -> std::convertible_to<TopologyView>;
};
/// Checks its elements against the points of the state.
template <class C>
concept HasInitOnPoints = requires(C c, InitContext<Vec3d> const context) { c.init(context); };

template <class C>
concept Topology = HasRole<C, role::Topology> && HasView<C> && HasInitOnPoints<C>;

// Hooks, what a topology may have beside these:

/// Makes its points and elements before all else.
template <class C>
concept Generates = requires(C c, std::string_view where) { c.generate(where); };
/// Its elements may be removed while the scene runs: edit(), its ElementLists.
template <class C>
concept Editable = requires(C c) { c.edit(); };
/// What asks for tetrahedra may find them here: `static constexpr bool mayHaveTetrahedra = true`.
template <class C>
concept MayHaveTetrahedra = requires { C::mayHaveTetrahedra; };

template <>
struct Promise<role::Topology> : NoPromise {
  template <class C>
  static constexpr bool kept = Topology<C>;
  template <class C>
  struct Broken {
    static_assert(
        HasView<C>,
        "Sinew: a topology has no 'TopologyView view() const', its elements as components see them.");
    static_assert(
        HasInitOnPoints<C>,
        "Sinew: a topology has no 'template <class D> void init(InitContext<D> const& context)', which "
        "checks its elements against the points of the state, context.rest.");
  };
};

}  // namespace sinew
