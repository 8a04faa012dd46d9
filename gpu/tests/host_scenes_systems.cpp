// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_systems.hpp"

namespace gpu_test {

template Course on_host<BlockJacobiBar, Vec3d>();
template Course on_host<JacobiBar, Vec3d>();
template Course on_host<PlainBar, Vec3d>();
template Course on_host<AssembledBar, Vec3d>();
template Course on_host<TwoAssembled<false>, Vec3d>();
template Course on_host<TwoAssembled<true>, Vec3d>();
template Course on_host<LoosePoints, Vec3d>();
template Course on_host<RigidsOnSprings, Rigid3d>();

}  // namespace gpu_test
