// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void MechanicalOperations<RuntimeScope<Standard>>::fill(AnyMatrix&, MatrixFactors);
}  // namespace sinew
