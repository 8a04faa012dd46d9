// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"
#include "samples_rigid.hpp"

namespace gpu_test {

template HostAnswers<Rigid3d> on_host<AngularSprings, Rigid3d>(int, bool);
template HostAnswers<Rigid3f> on_host<AngularSprings, Rigid3f>(int, bool);

}  // namespace gpu_test
