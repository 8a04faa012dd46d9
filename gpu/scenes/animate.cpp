// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/registry.hpp>
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using CudaSimulation = Simulation<RuntimeNode<CudaScenes>>;
extern template detail::ComponentOperations const& AnyComponent<CudaScenes>::operations(int);
template void Simulation<RuntimeNode<CudaScenes>>::animate(double);
template void Simulation<RuntimeNode<CudaScenes>>::propagate();
}  // namespace sinew
