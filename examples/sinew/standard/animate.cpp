// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void StandardSimulation::animate(double);
template void StandardSimulation::propagate();
template double StandardSimulation::kineticEnergy();
template double StandardSimulation::potentialEnergy();
}  // namespace sinew
