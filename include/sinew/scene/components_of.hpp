// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/node.hpp>

#include <tuple>

namespace sinew {

/// Addresses of all components of a typed node and of those below it, parents before children, each with its
/// type: what a program needs that is made for one scene.
template <class N>
auto components_of(N& node) {
  const auto own = hana::unpack(node.components, [](auto&... c) { return std::make_tuple(&c...); });
  return hana::unpack(node.children,
                      [&](auto&... child) { return std::tuple_cat(own, components_of(child)...); });
}

/// Those whose type fulfils `Test<C>::value`.
template <template <class> class Test, class... Cs>
auto components_that(std::tuple<Cs*...> const& all) {
  return std::apply(
      [](auto*... c) {
        return std::tuple_cat([&] {
          if constexpr (Test<std::remove_pointer_t<decltype(c)>>::value)
            return std::make_tuple(c);
          else
            return std::tuple<>{};
        }()...);
      },
      all);
}

}  // namespace sinew
