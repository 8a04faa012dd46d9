// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_rigid.hpp"

namespace gpu_test {

template Course on_host<Tumbling, Rigid3d>();
template Course on_host<AngularChain, Rigid3d>();

}  // namespace gpu_test
