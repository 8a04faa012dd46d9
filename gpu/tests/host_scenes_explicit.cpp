// SPDX-License-Identifier: BSL-1.0
#include "host_scenes.hpp"
#include "scenes_explicit.hpp"

namespace gpu_test {

template Course on_host<SwingingGrid<EulerExplicitSolver>, Vec3d>();
template Course on_host<SwingingGrid<EulerExplicitSolver>, Vec3f>();
template Course on_host<SwingingGrid<RungeKutta2Solver>, Vec3d>();
template Course on_host<HyperelasticCube, Vec3d>();

}  // namespace gpu_test
