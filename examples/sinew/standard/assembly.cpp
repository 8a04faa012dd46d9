// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void SystemMatrix<RuntimeScope<Standard>>::fill(AnyMatrix&, MechanicalParams const&) const;
}  // namespace sinew
