// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Step<RuntimeScope<Standard>>::detectContacts() const;
}  // namespace sinew
