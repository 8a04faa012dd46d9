// SPDX-License-Identifier: BSL-1.0
// Fluids of particles on the device against those of the processor.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include "agrees.hpp"
#include "error_of.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/force/fluid_boundary.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/sph_fluid.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <limits>

namespace test_particles_on_device {

using namespace gpu_test;

namespace {

constexpr std::size_t count = 500, bounds = 80;

// scattered, some in one place and one on its own far away
template <class H>
std::vector<typename H::Coord> places(std::size_t n, std::size_t from, double size) {
  std::vector<typename H::Coord> x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(noise<typename H::Coord>(from + i, size));
  return x;
}

template <class H>
struct Forces {
  std::vector<typename H::Deriv> onFluid{};
  std::vector<Eigen::Vector3d> onBoundary{};
  double energy = 0;

  bool operator==(Forces const&) const = default;
};

template <class D>
auto forces(SPHFluidForceField<D> fluid, bool bounded) {
  using H = HostOf<D>;
  auto points = places<H>(count, 0, 0.5);
  points[7] = points[3];
  points[9] = typename H::Coord(20, -30, 40);
  const typename D::VecCoord x(points);
  const typename D::VecDeriv v(places<H>(count, 900, 2));
  typename D::VecDeriv f(count, typename D::Deriv(1, 2, 3));
  fluid.init(InitContext<D>{"test", x, {}});
  if (bounded) {
    fluid.boundary.positions = places<Vec3d>(bounds, 2000, 0.5);
    fluid.boundary.velocities = places<Vec3d>(bounds, 3000, 1);
    fluid.boundary.forces.assign(bounds, Eigen::Vector3d::Zero());
    fluid.reserveForBoundary();
  }
  fluid.addForce({}, f, x, v);
  Forces<H> found{on_the_host(f), fluid.boundary.forces, 0};
  found.energy = fluid.potentialEnergy(x);
  return found;
}

template <class H>
void same_forces(auto const& with, bool bounded, double tolerance) {
  auto fluid = [&]<class D>(D) {
    SPHFluidForceField<D> made{.radius = 0.25, .mass = 2, .pressure = 3, .density = 900, .viscosity = 0.3};
    with(made);
    return made;
  };
  const auto host = forces(fluid(H{}), bounded), device = forces(fluid(CudaTypes<H>{}), bounded);
  CHECK(relative_difference(device.onFluid, host.onFluid) < tolerance);
  CHECK(device.energy == Approx(host.energy).epsilon(tolerance));
  CHECK(device == forces(fluid(CudaTypes<H>{}), bounded));
  REQUIRE(device.onBoundary.size() == (bounded ? bounds : 0));
  if (bounded) CHECK(relative_difference(device.onBoundary, host.onBoundary) < tolerance);
}

constexpr double dt = 0.001, radius = 0.1;

template <class D>
SPHFluidForceField<D> water() {
  return {.radius = radius,
          .mass = 0.125,
          .pressure = 400,
          .density = 1000,
          .viscosity = 1,
          .kernelType = 1,
          .viscosityType = 2};
}
std::vector<Eigen::Vector3d> block() {
  std::vector<Eigen::Vector3d> x;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 6; ++i) x.push_back(0.05 * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
  return x;
}
template <class D>
auto dam() {
  std::vector<typename D::Coord> x;
  for (auto const& p : block()) x.push_back(p.cast<typename D::Real>());
  using Wall = PlaneForceField<D>;
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}},
                                 node<"body">(EulerExplicitSolver{.symplectic = true},
                                              MechanicalObject<D>{x},
                                              UniformMass<D>{.vertexMass = 0.125},
                                              water<D>(),
                                              Wall{.normal = {0, 1, 0}, .d = 0.025, .stiffness = 5000},
                                              Wall{.normal = {1, 0, 0}, .d = 0.025, .stiffness = 5000},
                                              Wall{.normal = {0, 0, 1}, .d = 0.025, .stiffness = 5000}))};
}
// a box that falls into water
template <class D>
auto bath() {
  std::vector<typename D::Coord> x;
  for (auto const& p : block()) x.push_back(p.cast<typename D::Real>());
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) corners.push_back(0.05 * Eigen::Vector3d(i - 1, j - 1, k - 1));
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      node<"body">(EulerExplicitSolver{.symplectic = true},
                   MechanicalObject<D>{x},
                   UniformMass<D>{.vertexMass = 0.125},
                   water<D>(),
                   PlaneForceField<D>{.normal = {0, 1, 0}, .d = 0.025, .stiffness = 5000}),
      node<"box">(
          EulerExplicitSolver{.symplectic = true},
          MechanicalObject<Rigid3d>{.position = {{{0.15, 0.52, 0.15}}}},
          UniformMass<Rigid3d>{.totalMass = 1},
          node<"surface">(
              MechanicalObject<Vec3d>{corners}, RigidMapping<Rigid3d, Vec3d>{}, FluidBoundary<Vec3d>{})))};
}

}  // namespace

TEST_CASE("forces of a fluid on the device equal those of the processor, for all its kinds") {
  for (const bool bounded : {false, true})
    for (int kernel = 0; kernel < 2; ++kernel)
      for (int kind = 0; kind < 4; ++kind) {
        INFO("kernel " << kernel << ", viscosity and tension " << kind << ", boundary " << bounded);
        auto with = [&](auto& fluid) {
          fluid.kernelType = kernel;
          fluid.viscosityType = kind % 3;
          fluid.surfaceTension = kind == 0 ? 0 : 0.7;
          fluid.surfaceTensionType = kind;
          fluid.adhesion = 0.4;
          fluid.pressureType = kind == 2 ? 0 : 1;
        };
        same_forces<Vec3d>(with, bounded, 1e-11);
        // of single precision, with sums of forces that cancel to a thousandth
        same_forces<Vec3f>(with, bounded, 2e-3);
      }
}

TEST_CASE("a fluid on the device keeps momentum, and pushes boundaries as they push it") {
  SPHFluidForceField<CudaVec3d> fluid{
      .radius = 0.25, .mass = 2, .pressure = 3, .density = 900, .viscosity = 0.3, .kernelType = 1};
  for (const bool bounded : {false, true}) {
    const auto found = forces(fluid, bounded);
    Eigen::Vector3d sum = -double(count) * Eigen::Vector3d(1, 2, 3);
    double size = 0;
    for (auto const& f : found.onFluid) sum += f, size += f.norm();
    for (auto const& f : found.onBoundary) sum += f;
    CHECK(sum.norm() < 1e-13 * size);
  }
}

TEST_CASE("a dam breaks on the device as on the processor, and nothing crosses in a step") {
  auto host = dam<Vec3d>();
  auto device = dam<CudaVec3d>();
  host.init();
  device.init();
  for (int step = 0; step < 100; ++step) {
    if (step == 3) gpu::transfers() = {};
    host.animate(dt);
    device.animate(dt);
  }
  CHECK(gpu::transfers().toHost + gpu::transfers().toDevice == 0);
  auto const& x = host.at<"body">().state().position;
  CHECK(relative_difference(on_the_host(device.at<"body">().state().position), x) < 1e-9);
  CHECK((x.back() - block().back()).norm() > 0.02);  // there was something to do
}

TEST_CASE("a recorded step of a fluid is the step") {
  auto recorded = dam<CudaVec3f>(), stepped = dam<CudaVec3f>();
  recorded.init();
  stepped.init();
  gpu::RecordedStep step(recorded, dt);  // makes one
  step.animate(30);
  step.finish();
  for (int i = 0; i < 31; ++i) stepped.animate(dt);
  CHECK(recorded.at<"body">().state().position == stepped.at<"body">().state().position);
}

TEST_CASE("bodies of the processor meet a fluid of the device") {
  auto host = bath<Vec3d>();
  auto device = bath<CudaVec3d>();
  host.init();
  device.init();
  for (int step = 0; step < 150; ++step) {
    host.animate(dt);
    device.animate(dt);
  }
  auto const& box = host.at<"box">().state();
  CHECK((device.at<"box">().state().position[0].center - box.position[0].center).norm() < 1e-9);
  // it would have fallen freely
  CHECK(box.velocity[0][1] > -9.81 * 0.9 * 150 * dt);
}

TEST_CASE("particles that have no cell are named") {
  using D = CudaVec3d;
  auto said = [](Eigen::Vector3d const& x, Eigen::Vector3d const& wall) {
    SPHFluidForceField<D> fluid{.radius = 0.1};
    const D::VecCoord points{{0, 0, 0}, x, {0, 0, 0}};
    fluid.init(InitContext<D>{"water", points, {}});
    fluid.boundary = {{wall}, {wall}, {wall}};
    D::VecDeriv f(3, D::Deriv::Zero());
    return error_of([&] { fluid.addForce({}, f, points, f); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Catch::Matchers::Contains;
  CHECK_THAT(said({0, nan, 0}, {0, 0, 0}),
             Contains("water: SPHFluidForceField") && Contains("point 1 is not"));
  CHECK_THAT(said({0, 0, 0}, {0, nan, 0}), Contains("point 3 is not a finite number"));
  CHECK_THAT(said({0, 0, 2e6}, {0, 0, 0}),
             Contains("point 1 is at (0, 0, 2000000) m") && Contains("take a larger radius"));
}

}  // namespace test_particles_on_device
