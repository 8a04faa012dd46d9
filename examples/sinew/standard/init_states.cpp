// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Simulation<RuntimeNode<Standard>>::checkFields(RootScope const&, InitAgain const&);
template void Simulation<RuntimeNode<Standard>>::initStates(RootScope const&, InitAgain const&);
}  // namespace sinew
