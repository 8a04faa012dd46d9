// SPDX-License-Identifier: BSL-1.0
// What is said where something is wrong, and that the program goes on.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/gpu/gpu.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_errors {

using namespace sinew;

namespace {

// two points on a spring that an explicit step of 1 s overshoots ever more
template <class D>
auto diverging() {
  return Simulation{
      node<"root">(EulerExplicitSolver{},
                   node<"pair">(MechanicalObject<D>{.position = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}},
                                UniformMass<D>{.vertexMass = 1},
                                StiffSpringForceField<D>{{{0, 1, 1e5, 0, 1.0}}}))};
}
template <class D>
std::string divergence(long& step) {
  auto sim = diverging<D>();
  sim.init();
  const std::string what = error_of([&] {
    for (int i = 0; i < 1000; ++i) sim.animate(1);
  });
  step = sim.step();
  return what;
}

}  // namespace

TEST_CASE("a scene on the device that diverges is stopped as on the host") {
  long host = 0, device = 0;
  const std::string said = divergence<Vec3d>(host);
  CHECK(said.find("finite") != std::string::npos);
  std::string onDevice = divergence<CudaVec3d>(device);
  for (std::size_t at; (at = onDevice.find("CudaVec3d")) != std::string::npos;) onDevice.erase(at, 4);
  CHECK(onDevice == said);
  CHECK(std::abs(device - host) <= 1);  // the last bits of huge numbers
}

TEST_CASE("components on the device refuse elements with points that are not there") {
  const CudaVec3d::VecCoord rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  StiffSpringForceField<CudaVec3d> springs{{{0, 4, 100, 0, 1.0}}};
  const std::string said = error_of([&] { springs.init({"body", rest, {}}); });
  CHECK(said.find("body: StiffSpringForceField<CudaVec3d>: springs[0] refers to point 4") == 0);
  const std::vector<Tetrahedron> wrong{{0, 1, 2, 7}};
  TetrahedronFEMForceField<CudaVec3d> fem;
  const std::string other = error_of([&] { fem.init({"body", rest, {.tetrahedra = wrong}}); });
  CHECK(other.find("TetrahedronFEMForceField<CudaVec3d>") != std::string::npos);
  CHECK(other.find("7") != std::string::npos);
  CHECK(component_name<TetrahedronFEMForceField<CudaVec3f>>() == "TetrahedronFEMForceField<CudaVec3f>");
}

TEST_CASE("a step that takes a body from the device to the host is not recorded") {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      node<"body">(MechanicalObject<CudaVec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                   UniformMass<CudaVec3d>{},
                   node<"there">(MechanicalObject<CudaVec3d>{}, IdentityMapping<CudaVec3d, CudaVec3d>{}),
                   node<"here">(MechanicalObject<Vec3d>{}, IdentityMapping<CudaVec3d, Vec3d>{})))};
  sim.init();
  CHECK(error_of([&] { gpu::RecordedStep recorded(sim, 0.01); }) ==
        "/root/body/here: IdentityMapping<CudaVec3d, Vec3d> joins the device and the host in every step, "
        "which a "
        "recorded step cannot; put both bodies on the device, or animate() the simulation");
  CHECK(sim.step() == 0);
  sim.animate(0.01);
}

#if SINEW_CUDA

namespace {
struct Doubled {
  double* v;
  SINEW_HD void operator()(int i) const { v[i] *= 2; }
};
}  // namespace

TEST_CASE("far too much memory of the GPU is refused, and the program goes on") {
  gpu::DeviceArray<double> array;
  array.resize(10);
  double* const before = array.data();
  const std::string said = error_of([&] { array.resize(1'000'000'000'000); });
  CHECK(said.find("memory of the GPU: 7629394 MiB are needed, ") == 0);
  CHECK(said.find("make the body smaller") != std::string::npos);
  CHECK(array.data() == before);  // what was there stays
  const double five = 5;
  gpu::copy_to_device(before + 9, &five, 1);
  double back = 0;
  gpu::copy_to_host(&back, before + 9, 1);
  CHECK(back == 5);
  gpu::DeviceVector<double> v(100, 2.0);
  gpu::for_each_index(100, Doubled{v.device()});
  CHECK(v[99] == 4);
}

// run by itself, where no GPU may be seen
TEST_CASE("without a GPU it is said what to do", "[.][without-gpu]") {
#if SINEW_CUDA
  int count = 0;
  REQUIRE(!(cudaGetDeviceCount(&count) == cudaSuccess && count > 0));
#endif
  auto sim = diverging<CudaVec3d>();
  for (int again = 0; again < 2; ++again) {
    const std::string said = error_of([&] {
      sim.init();
      sim.animate(1e-3);
    });
    CHECK(said.find(
              "there is no GPU that this program can use; run it on a machine with one and its driver, or "
              "take DataTypes of the processor, such as Vec3f for CudaVec3f") != std::string::npos);
  }
}

#endif

}  // namespace test_errors
