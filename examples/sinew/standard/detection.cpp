// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Simulation<RuntimeNode<Standard>>::detectContacts(RootScope const&, double) const;
}  // namespace sinew
