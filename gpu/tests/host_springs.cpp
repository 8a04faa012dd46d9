// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"
#include "samples_springs.hpp"

namespace gpu_test {

template HostAnswers<Vec3d> on_host<GridSprings, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<GridSprings, Vec3f>(int, bool);
template HostAnswers<Vec3d> on_host<PenaltyPlane, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<PenaltyPlane, Vec3f>(int, bool);
template HostAnswers<Vec3d> on_host<PenaltySphere, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<PenaltySphere, Vec3f>(int, bool);

}  // namespace gpu_test
