// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
template TopologyChange Simulation<RuntimeNode<Standard>>::removeElements(std::string_view,
                                                                          ElementNumbers const&);
}  // namespace sinew
