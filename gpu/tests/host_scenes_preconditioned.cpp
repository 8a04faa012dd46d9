// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_preconditioned.hpp"

namespace gpu_test {

template Course on_host<BlockJacobiBar, Vec3d>();
template Course on_host<JacobiBar, Vec3d>();
template Course on_host<PlainBar, Vec3d>();
template Course on_host<RigidsOnSprings, Rigid3d>();

}  // namespace gpu_test
