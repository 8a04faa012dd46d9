// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>

namespace sinew {
template ReadScene<Standard> read_scene<Standard>(std::string const&, ReadSceneOptions const&, checks::Right);
template ReadScene<Standard> parse_scene<Standard>(std::string const&, std::string, ReadSceneOptions const&,
                                                   checks::Right);
}  // namespace sinew
