// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Initialisation<RuntimeScope<Standard>>::initComponents();
}  // namespace sinew
