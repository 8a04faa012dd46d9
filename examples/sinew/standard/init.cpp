// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Simulation<RuntimeNode<Standard>>::init(double, long);
template void Simulation<RuntimeNode<Standard>>::initScene(RootScope const&, InitAgain const&);
template void Simulation<RuntimeNode<Standard>>::initSolvers(RuntimeScope<Standard> const&, InitAgain const&,
                                                             std::vector<void const*>&);
}  // namespace sinew
