// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/context.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace sinew::detail {

/// The elements that a mapping measures: those of the topology in its node, or else of its parent's.
/// `elementsOf` has them from a TopologyView; `one` and `many` are their name in messages. Throws Error where
/// neither has any, or one has a point that the parent lacks.
template <class In, class Out, class ElementsOf>
auto measured_elements(InitContext<In> const& parent, InitContext<Out> const& child, std::string const& where,
                       std::string_view one, std::string_view many, ElementsOf const& elementsOf) {
  auto elements = std::invoke(elementsOf, child.topology);
  if (elements.empty()) elements = std::invoke(elementsOf, parent.topology);
  if (elements.empty())
    throw Error(
        where,
        text("there are no ", many, ", neither in its node nor in its parent's; add a topology with some"));
  check_indices(where, one, elements, parent.rest.size());
  return elements;
}

}  // namespace sinew::detail
