// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/registry.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace sinew {
extern template detail::ComponentOperations const& AnyComponent<CudaScenes>::operations(int);
template std::vector<ClassInfo> make_class_table<CudaScenes>();
template ReadScene<CudaScenes> read_scene<CudaScenes>(std::string const&, ReadSceneOptions const&,
                                                      checks::Right);
template ReadScene<CudaScenes> parse_scene<CudaScenes>(std::string const&, std::string,
                                                       ReadSceneOptions const&, checks::Right);
template std::string scene_text<CudaScenes>(Simulation<RuntimeNode<CudaScenes>>&, double);
}  // namespace sinew
