// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void Simulation<RuntimeNode<Standard>>::init(double, long);
template void Initialisation<RuntimeScope<Standard>>::run();
template void Initialisation<RuntimeScope<Standard>>::initSolvers();
}  // namespace sinew
