// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Simulation<RuntimeNode<Standard>>::animate(double);
template void Simulation<RuntimeNode<Standard>>::propagate();
template double Simulation<RuntimeNode<Standard>>::kineticEnergy();
template double Simulation<RuntimeNode<Standard>>::potentialEnergy();
}  // namespace sinew
