// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/registry.hpp>
#include <sinew/runtime/any_component.hpp>

namespace sinew {
template detail::ComponentOperations const& AnyComponent<CudaScenes>::operations(int);
}  // namespace sinew
