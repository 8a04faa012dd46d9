// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "scenes.hpp"

#include <sinew/gpu/gpu.hpp>

namespace gpu_test {

/// A scene over CudaTypes<H> goes as over H: the largest difference of positions over the largest of them
/// stays below `maximum`. It does so with the same bits again; and where Scene::onDevice, after its first
/// three steps nothing crosses between host and device.
template <class Scene, class H>
void same_as_host(double maximum) {
  auto crossed = [](bool zero) {
    const auto t = gpu::transfers();
    if (zero) gpu::transfers() = {};
    return t.toHost + t.toDevice;
  };
  std::vector<std::size_t> seen;
  const Course device = run<Scene, CudaTypes<H>>([&] { seen.push_back(crossed(true)); });
  REQUIRE(seen.size() == 2);
  CHECK((seen[1] == 0) == Scene::onDevice);

  const Course host = on_host<Scene, H>();
  REQUIRE(device.position.size() == host.position.size());
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < host.position.size(); ++i) {
    const double d = std::abs(device.position[i] - host.position[i]);
    difference = d <= difference ? difference : d;  // a NaN stays
    size = std::max(size, std::abs(host.position[i]));
  }
  INFO("difference " << difference / size << ", moved " << host.moved << " of " << size);
  CHECK(difference <= maximum * size);
  CHECK(host.moved > 0.01 * size);  // there was something to do
  // a quadratic form of strains that are a hundredth of the size
  CHECK(device.energy == Approx(host.energy).epsilon(1e4 * maximum));

  const Course again = run<Scene, CudaTypes<H>>([] {});
  CHECK((again == device));
}

}  // namespace gpu_test
