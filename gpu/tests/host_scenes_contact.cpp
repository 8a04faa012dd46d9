// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_contact.hpp"

namespace gpu_test {

template Course on_host<SlidingBlock, Vec3d>();
template Course on_host<SlidingBlock, Vec3f>();
template Course on_host<HeldBlock, Vec3d>();
template Course on_host<StackedBlocks, Vec3d>();

}  // namespace gpu_test
