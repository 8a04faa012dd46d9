// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template TopologyChange Simulation<RuntimeNode<Standard>>::removeElements(std::string_view,
                                                                          ElementNumbers const&);
template TopologyChange Simulation<RuntimeNode<Standard>>::addElements(std::string_view, AddedElements const&);
template void Simulation<RuntimeNode<Standard>>::reset();
template void Simulation<RuntimeNode<Standard>>::finish();
}  // namespace sinew
