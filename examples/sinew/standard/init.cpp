// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using StandardSimulation = Simulation<RuntimeNode<Standard>>;
extern template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
template void Simulation<RuntimeNode<Standard>>::init(double, long);
template void Simulation<RuntimeNode<Standard>>::initScene(RootScope const&, InitAgain const&);
template void Simulation<RuntimeNode<Standard>>::reset();
template void Simulation<RuntimeNode<Standard>>::finish();
template void Simulation<RuntimeNode<Standard>>::updateVisual();
}  // namespace sinew
