// SPDX-License-Identifier: BSL-1.0
// The Thrust driver on a GPU. Ends with 77, which ctest takes for "skipped", where there is none.
#include "device_answers.hpp"

#include <cstdio>

using namespace gpu_test;

namespace {

int failures = 0;

void check(bool holds, std::string const& what, double value) {
  std::printf("%-6s %-58s %9.2e\n", holds ? "ok" : "FAILED", what.c_str(), value);
  failures += !holds;
}

template <template <class> class LawOf, class D, class... Method>
void agrees(std::string const& name, Body<LawOf, D> const& body, Method... method) {
  const LawOf<D> law{method...};
  const Answer<D> device = on_device(law, body);
  const HostAnswers<D> host = on_host(body, method...);
  const double scalar = relative_difference(device, host.scalar),
               lanes = relative_difference(device, host.lanes);
  check(scalar < rounding<typename D::Real>, name + ": equals the CPU", scalar);
  check(lanes < rounding<typename D::Real>, name + ": equals the CPU's lanes", lanes);
  const double again = relative_difference(on_device(law, body), device);
  check(on_device(law, body) == device && again == 0, name + ": the same bits again", again);
}

template <class D>
void checkAll() {
  const std::string type(data_types_name<D>::value);
  agrees(type + " springs", spring_network<D>(700, 6001));
  for (std::size_t m = 0; m < 4; ++m)
    agrees(text(type, " tetrahedra, ", enum_names(RotationMethod{})[m]),
           tetrahedra<D>(RotationMethod(m)),
           RotationMethod(m));
  const Fall<D> fall = falling_springs<D>();
  const double difference = relative_difference(fall_on_device(fall), fall.after);
  check(difference < 10 * rounding<typename D::Real>,
        type + " symplectic Euler: equals the Simulation",
        difference);
}

}  // namespace

int main() {
  int devices = 0;
  if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
    std::puts("skipped: there is no GPU");
    return 77;
  }
  checkAll<Vec3d>();
  checkAll<Vec3f>();
  std::printf("%d checks failed\n", failures);
  return failures != 0;
}
