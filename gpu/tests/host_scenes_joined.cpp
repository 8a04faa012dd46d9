// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_joined.hpp"

namespace gpu_test {

template Course on_host<TwoBlocks, Vec3d>();
template Course on_host<HostForce, Vec3d>();
template Course on_host<Assembled, Vec3d>();

}  // namespace gpu_test
