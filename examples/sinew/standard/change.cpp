// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using StandardSimulation = Simulation<RuntimeNode<Standard>>;
extern template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
extern template void StandardSimulation::initScene(RootScope const&, InitAgain const&);
extern template void StandardSimulation::propagate();
template TopologyChange StandardSimulation::removeElements(std::string_view, ElementNumbers const&);
}  // namespace sinew
