// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_grid.hpp"

namespace gpu_test {

template Course on_host<HexahedraBar, Vec3d>();
template Course on_host<GridOnPlane, Vec3d>();

}  // namespace gpu_test
