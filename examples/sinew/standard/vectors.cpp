// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template struct StateVectors<RuntimeScope<Standard>>;
template void StateVectors<RuntimeScope<Standard>>::eq(CoordId, CoordId) const;
template void StateVectors<RuntimeScope<Standard>>::eq(DerivId, DerivId) const;
template void StateVectors<RuntimeScope<Standard>>::gather(Eigen::VectorXd&, DerivId) const;
template void StateVectors<RuntimeScope<Standard>>::scatter(DerivId, Eigen::VectorXd const&) const;
}  // namespace sinew
