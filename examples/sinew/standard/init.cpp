// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using StandardSimulation = Simulation<RuntimeNode<Standard>>;
template void StandardSimulation::init();
template void StandardSimulation::initScene(RootScope const&, bool);
template void StandardSimulation::reset();
template void StandardSimulation::updateVisual();
}  // namespace sinew
