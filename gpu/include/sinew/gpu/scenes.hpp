// SPDX-License-Identifier: BSL-1.0
#pragma once

// Scene files on a device: the registry CudaScenes, instantiated once in the sources of gpu/scenes, which a
// program links. Without them, include sinew/gpu/registry.hpp and the headers of sinew/runtime.
#include <sinew/gpu/registry.hpp>

#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace sinew {

using CudaSimulation = Simulation<RuntimeNode<CudaScenes>>;

extern template detail::ComponentOperations const& AnyComponent<CudaScenes>::operations(int);

extern template void Simulation<RuntimeNode<CudaScenes>>::init(double, long);
extern template void Initialisation<RuntimeScope<CudaScenes>>::run();
extern template void Simulation<RuntimeNode<CudaScenes>>::animate(double);
extern template void Simulation<RuntimeNode<CudaScenes>>::reset();
extern template void Simulation<RuntimeNode<CudaScenes>>::finish();
extern template void Simulation<RuntimeNode<CudaScenes>>::propagate();
extern template void Simulation<RuntimeNode<CudaScenes>>::updateVisual();

extern template std::vector<ClassInfo> make_class_table<CudaScenes>();
extern template ReadScene<CudaScenes> read_scene<CudaScenes>(std::string const&, ReadSceneOptions const&,
                                                             checks::Right);
extern template ReadScene<CudaScenes> parse_scene<CudaScenes>(std::string const&, std::string,
                                                              ReadSceneOptions const&, checks::Right);
extern template std::string scene_text<CudaScenes>(CudaSimulation&, double);

}  // namespace sinew
