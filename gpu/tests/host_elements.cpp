// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"
#include "samples_elements.hpp"

namespace gpu_test {

template HostAnswers<Vec3d> on_host<Tetrahedra, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<Tetrahedra, Vec3f>(int, bool);
template HostAnswers<Vec3d> on_host<Hexahedra, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<Hexahedra, Vec3f>(int, bool);
template HostAnswers<Vec3d> on_host<Triangles, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<Triangles, Vec3f>(int, bool);
template HostAnswers<Vec3d> on_host<Bending, Vec3d>(int, bool);
template HostAnswers<Vec3f> on_host<Bending, Vec3f>(int, bool);

}  // namespace gpu_test
