// SPDX-License-Identifier: BSL-1.0
#include <sinew/registry.hpp>
#include <sinew/runtime/any_component.hpp>

namespace sinew {
template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
}  // namespace sinew
