// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <type_traits>

namespace sinew {

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
  each([](auto& m, auto& child, auto& parent) { m.apply(child.position, parent.position); });
}

}  // namespace sinew
