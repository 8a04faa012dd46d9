// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void MechanicalOperations<RuntimeScope<Standard>>::computeForce(DerivId, CoordId, DerivId, double);
template double MechanicalOperations<RuntimeScope<Standard>>::potentialEnergy();
}  // namespace sinew
