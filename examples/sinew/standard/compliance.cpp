// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void ConstrainedStep<RuntimeScope<Standard>>::findCompliance(ConstrainedMotion&, bool) const;
}  // namespace sinew
