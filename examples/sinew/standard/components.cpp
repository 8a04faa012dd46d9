// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
}  // namespace sinew
