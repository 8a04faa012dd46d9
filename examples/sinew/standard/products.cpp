// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void MechanicalOperations<RuntimeScope<Standard>>::addMBKdx(DerivId, DerivId, MatrixFactors);
template void MechanicalOperations<RuntimeScope<Standard>>::accFromF(DerivId, DerivId, CoordId);
template double MechanicalOperations<RuntimeScope<Standard>>::kineticEnergy();
}  // namespace sinew
