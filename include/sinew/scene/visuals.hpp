// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <type_traits>

namespace sinew {

/// A visual model follows its mapping now.
template <class M, class Child, class Parent>
void follow_mapping(M& mapping, Child& child, Parent const& parent) {
  mapping.apply(child.position, parent.position);
  if constexpr (MakesFaces<M>) {
    child.mesh = {};
    child.mesh.quads = mapping.faces();
    child.mesh = child.current();
  }
}

/// Visual models follow their mappings. Those whose parents are on a device are all asked for before the
/// first is waited for.
template <class RootScope>
void update_visuals(RootScope const& root) {
  auto each = [&](auto&& f) {
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
                 if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>) f(m, child, parent);
               });
             }));
  };
  each([](auto& m, auto& child, auto& parent) {
    if constexpr (requires { m.ask(child.position, parent.position); })
      m.ask(child.position, parent.position);
  });
  each([](auto& m, auto& child, auto& parent) { follow_mapping(m, child, parent); });
}

}  // namespace sinew
