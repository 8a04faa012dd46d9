// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/bake.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace sinew {
template std::string scene_text<Standard>(Simulation<RuntimeNode<Standard>>&, double);
template std::vector<std::vector<CppMember>> cpp_members<Standard>();
template std::string bake_text<Standard>(ReadScene<Standard>, std::string const&, BakeOptions const&);
}  // namespace sinew
