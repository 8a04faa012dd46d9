// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/registry.hpp>
#include <sinew/runtime/runtime.hpp>

namespace sinew {
using CudaSimulation = Simulation<RuntimeNode<CudaScenes>>;
extern template detail::ComponentOperations const& AnyComponent<CudaScenes>::operations(int);
extern template void Simulation<RuntimeNode<CudaScenes>>::propagate();
template void Simulation<RuntimeNode<CudaScenes>>::init(double, long);
template void Initialisation<RuntimeScope<CudaScenes>>::run();
template void Simulation<RuntimeNode<CudaScenes>>::reset();
template void Simulation<RuntimeNode<CudaScenes>>::finish();
template void Simulation<RuntimeNode<CudaScenes>>::updateVisual();
}  // namespace sinew
