// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_bar.hpp"

namespace gpu_test {

template Course on_host<Bar, Vec3d>();
template Course on_host<Bar, Vec3f>();

}  // namespace gpu_test
