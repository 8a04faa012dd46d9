// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void StandardSimulation::init();
template void StandardSimulation::initScene(RootScope const&, bool);
template void StandardSimulation::reset();
template void StandardSimulation::updateVisual();
}  // namespace sinew
