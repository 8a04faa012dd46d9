// SPDX-License-Identifier: BSL-1.0
// A loop on a device: the least that needs the flags of sinew::gpu.
#include <sinew/gpu/device_vector.hpp>

#include <cstdio>
#include <exception>

namespace {

struct Add {
  double* v;
  double by;
  SINEW_HD void operator()(int i) const { v[i] += by; }
};

}  // namespace

int main() try {
  sinew::gpu::DeviceVector<double> v{1, 2, 3};
  sinew::gpu::for_each_index(v.size(), Add{v.device(), 10});
  std::printf("the device has made %g\n", v.host()[2]);
} catch (std::exception const& error) {
  std::printf("%s\n", error.what());
  return 1;
}
