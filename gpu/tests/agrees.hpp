// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "answers.hpp"
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#if defined(_OPENMP)
#include <omp.h>
#endif

namespace gpu_test {

template <class Sample, class H>
Answer<H> on_device(int v, bool fewer) {
  const auto motion = motion_of<Sample, H>();
  auto force = ready<Sample, CudaTypes<H>>(v, motion);
  return answer_of<CudaTypes<H>>(force, motion, fewer);
}

/// f() with other numbers of threads, where Thrust's device has them.
template <class F>
void with_other_threads(F&& f) {
#if defined(_OPENMP)
  const int threads = omp_get_max_threads();
  for (const int n : {1, 2, 3, 7}) {
    omp_set_num_threads(n);
    f();
  }
  omp_set_num_threads(threads);
#else
  f();
#endif
}

/// All variants of a force field over CudaTypes<H> answer what those over H answer, to `factor` times the
/// rounding of a sum, and have the same bits again, with any number of threads.
template <class Sample, class H>
void agrees(double factor = 1) {
  const double maximum = factor * rounding<typename H::Real>;
  for (int v = 0; v < Sample::variants; ++v) {
    INFO("variant " << v);
    const Answer<H> device = on_device<Sample, H>(v, false);
    const HostAnswers<H> host = on_host<Sample, H>(v, false);
    CHECK(relative_difference(device, host.lanes) < maximum);
    CHECK(relative_difference(device, host.scalar) < maximum);
    CHECK(device.energy > 0);
    with_other_threads([&] { CHECK((on_device<Sample, H>(v, false) == device)); });
  }
  const HostAnswers<H> host = on_host<Sample, H>(0, true);
  CHECK(host.lanes.removed > 0);
  CHECK(relative_difference(on_device<Sample, H>(0, true), host.lanes) < maximum);
}

/// Largest force of a sample on the device at some positions, on the points that `counts` says, over that in
/// its crumpled motion.
template <class Sample, class H, class Counts>
double relative_force(int v, std::vector<typename H::Coord> const& at, Motion<H> const& motion,
                      Counts&& counts) {
  using D = CudaTypes<H>;
  using Deriv = typename H::Deriv;
  auto force = ready<Sample, D>(v, motion);
  auto largest = [&](std::vector<typename H::Coord> const& positions, auto&& of) {
    const typename D::VecCoord x(positions);
    const typename D::VecDeriv still(x.size(), Deriv::Zero());
    typename D::VecDeriv f(x.size(), Deriv::Zero());
    add_force(force, {}, f, x, still);
    double maximum = 0;
    for (std::size_t i = 0; i < f.size(); ++i)
      if (of(int(i))) maximum = std::max(maximum, double(f[i].norm()));
    return maximum;
  };
  return largest(at, counts) / largest(motion.x, [](int) { return true; });
}

/// Moving a body as a whole costs nothing.
template <class Sample, class H>
void moves_freely(int v) {
  INFO("variant " << v);
  const auto motion = motion_of<Sample, H>();
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(0.4, -0.3, 0.6, 0.5).normalized();
  std::vector<typename H::Coord> x;
  for (auto const& rest : motion.rest) {
    const Eigen::Vector3d p = rotation * rest.template cast<double>() + Eigen::Vector3d(3, -2, 1);
    x.push_back(p.template cast<typename H::Real>());
  }
  // positions of 4 m rounded, in elements of 0.5 m that are strained by 0.2 in the motion
  const double maximum = 100 * rounding<typename H::Real>;
  CHECK(relative_force<Sample, H>(v, x, motion, [](int) { return true; }) < maximum);
}

/// The patch test: in an affine deformation all elements have the same stress, and inner points no force.
template <class Sample, class H>
void passes_patch_test(int v) {
  INFO("variant " << v);
  const auto motion = motion_of<Sample, H>();
  std::vector<bool> outer(motion.rest.size(), false);
  for (Triangle const& t : motion.block.triangles)
    for (const int i : t) outer[std::size_t(i)] = true;
  CHECK(std::count(outer.begin(), outer.end(), false) == 6);
  Eigen::Matrix3d a;
  a << 1.1, 0.05, -0.02, 0.1, 0.93, 0.04, 0.03, -0.08, 1.04;
  std::vector<typename H::Coord> x;
  for (auto const& rest : motion.rest) {
    const Eigen::Vector3d p = a * rest.template cast<double>();
    x.push_back(p.template cast<typename H::Real>());
  }
  const double maximum = 100 * rounding<typename H::Real>;
  CHECK(relative_force<Sample, H>(v, x, motion, [&](int i) { return !outer[std::size_t(i)]; }) < maximum);
  CHECK(relative_force<Sample, H>(v, x, motion, [&](int i) { return outer[std::size_t(i)]; }) > 0.01);
}

}  // namespace gpu_test
