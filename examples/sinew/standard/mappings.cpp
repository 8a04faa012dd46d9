// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void MechanicalOperations<RuntimeScope<Standard>>::propagate(CoordId, DerivId);
template void MechanicalOperations<RuntimeScope<Standard>>::propagate(DerivId);
template void MechanicalOperations<RuntimeScope<Standard>>::projectResponse(DerivId);
template void MechanicalOperations<RuntimeScope<Standard>>::projectPositionAndVelocity(double, CoordId,
                                                                                       DerivId);
template void Simulation<RuntimeNode<Standard>>::updateVisual();
template void RuntimeScope<Standard>::expand(int, JacobianVisitor const&) const;
}  // namespace sinew
