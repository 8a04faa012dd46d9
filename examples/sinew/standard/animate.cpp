// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using StandardSimulation = Simulation<RuntimeNode<Standard>>;
template void StandardSimulation::animate(double);
template void StandardSimulation::propagate();
template double StandardSimulation::kineticEnergy();
template double StandardSimulation::potentialEnergy();
}  // namespace sinew
