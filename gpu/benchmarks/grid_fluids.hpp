// SPDX-License-Identifier: BSL-1.0
#pragma once

// A dam that breaks in a cube of cells (Fluid3D), the scene of benchmarks/run/fluids.cpp, for fluids.cu.
#include <sinew/gpu/gpu.hpp>

#include <sinew/context/gravity.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/scene/simulation.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

namespace grid_fluids {

using namespace sinew;

/// Numbers of fields that the loops of a step read or write, a cell: in each iteration of the pressure those
/// of the cycle on the finest grid (36), with the coarse ones an eighth more each, and those of conjugate
/// gradients (19); outside them advection of the surface (15) and of the velocity (45), distances (22), the
/// volume (6), equations (15), the rest (32).
constexpr double inIteration = 36 * 8. / 7 + 19, outside = 135;

inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of a copy on the device, read and written [bytes/s].
inline double copy_bandwidth() {
  constexpr std::size_t n = std::size_t(1) << 27;
  gpu::WorkArray<float> from, to;
  from.resize(n);
  to.resize(n);
  gpu::clear_on_device(from.data(), n);
  double best = 1e9;
  for (int k = 0; k < 6; ++k) {
    gpu::wait();
    const double began = now();
    for (int i = 0; i < 4; ++i) gpu::copy_on_device(to.data(), from.data(), n);
    gpu::wait();
    best = std::min(best, (now() - began) / 4);
  }
  return 2. * n * sizeof(float) / best;
}

template <class D>
auto scene(int n) {
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}},
                                 node<"water">(Fluid3D<D>{.nx = n + 2,
                                                          .ny = n + 2,
                                                          .nz = n + 2,
                                                          .cellwidth = 1. / n,
                                                          .height = n / 3.,
                                                          .dir = {1, 0.3, 0}}))};
}

/// Prints cells; real; steps a second, the median of so many behind the first `settling`; iterations of the
/// pressure, their mean; million cells a second; bytes that the loops read and write a second, over those of
/// a copy.
template <class D>
void measure(int n, int steps, int settling, bool host) {
  using Real = typename D::Real;
  const double dt = 0.5 / n / 3, cells = double(n) * n * n;
  const double bandwidth = copy_bandwidth();
  auto sim = scene<D>(n);
  sim.init();
  auto& fluid = sim.template at<"water">().template get<Fluid3D<D>>();
  for (int i = 0; i < settling; ++i) sim.animate(dt);
  gpu::wait();
  if (host) {
    auto same = scene<typename D::Host>(n);
    same.init();
    for (int i = 0; i < settling; ++i) same.animate(dt);
    auto& other = same.template at<"water">().template get<Fluid3D<typename D::Host>>();
    double apart = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < fluid.grid.grid().size; ++i)
        apart = std::max(
            apart,
            std::abs(double(fluid.grid.velocity.value[c][i]) - double(other.grid.velocity.value[c][i])));
    std::printf("after %d steps %.1e m/s from the processor's\n", settling, apart);
  }
  std::vector<double> times;
  double iterations = 0;
  for (int i = 0; i < steps; ++i) {
    const double began = now();
    sim.animate(dt);
    gpu::wait();
    times.push_back(now() - began);
    iterations += fluid.grid.pressureSolve.iterations;
  }
  iterations /= steps;
  std::nth_element(times.begin(), times.begin() + steps / 2, times.end());
  const double seconds = times[std::size_t(steps) / 2];
  const double bytes = (outside + inIteration * iterations) * sizeof(Real) * cells;
  std::printf("%.0f; %s; %.1f; %.1f; %.1f; %.2f of %.2f TB/s; residual %.1e; energy %.6g J\n",
              cells,
              sizeof(Real) == 4 ? "float" : "double",
              1 / seconds,
              iterations,
              1e-6 * cells / seconds,
              bytes / seconds / bandwidth,
              1e-12 * bandwidth,
              fluid.grid.pressureSolve.residual,
              fluid.kineticEnergy());
}

}  // namespace grid_fluids
