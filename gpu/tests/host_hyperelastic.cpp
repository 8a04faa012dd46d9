// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"
#include "samples_hyperelastic.hpp"

namespace gpu_test {

template HostAnswers<Vec3d> on_host<Hyperelasticity, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<Hyperelasticity, Vec3f>(int, bool);

}  // namespace gpu_test
