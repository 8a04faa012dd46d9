// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using StandardSimulation = Simulation<RuntimeNode<Standard>>;
extern template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
// carving calls it; change.cpp has it
extern template TopologyChange Simulation<RuntimeNode<Standard>>::removeElements(std::string_view,
                                                                                 ElementNumbers const&);
template void Simulation<RuntimeNode<Standard>>::animate(double);
template void Simulation<RuntimeNode<Standard>>::propagate();
template double Simulation<RuntimeNode<Standard>>::kineticEnergy();
template double Simulation<RuntimeNode<Standard>>::potentialEnergy();
}  // namespace sinew
