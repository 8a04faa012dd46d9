// SPDX-License-Identifier: BSL-1.0
// Fluids on grids on the device against those of the processor.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include "agrees.hpp"
#include "error_of.hpp"
#include "immersed_shapes.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/force/immersed_solid.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include <limits>
#include <memory>

namespace test_grid_fluids_on_device {

using namespace sinew;
using namespace sinew::fluid;
using Catch::Matchers::Contains;

namespace {

constexpr double dt = 0.01;

// what a tank may have
enum Variant { plain, viscous, semiLagrangian, poured, blocked, variants };

template <class D>
Fluid3D<D> tank(int variant) {
  Fluid3D<D> fluid{.nx = 16, .ny = 14, .nz = 9, .cellwidth = 0.1, .height = 6.5, .dir = {0.4, 1, 0.1}};
  if (variant == viscous) fluid.viscosity = 3, fluid.walls = Walls::stick;
  if (variant == semiLagrangian) fluid.advection = Advection::semiLagrangian;
  if (variant == poured)
    fluid.source = {0, 0.4, 0}, fluid.sourceRadius = 0.15, fluid.sourceVelocity = {1, -2, 0};
  if (variant == blocked) fluid.obstacle = {{0.1, -1, -1, 0.35, 0, 1}}, fluid.viscosity = 1;
  return fluid;
}
template <class D>
Fluid2D<D> sheet(int variant) {
  Fluid2D<D> fluid{.nx = 34, .ny = 27, .cellwidth = 0.05, .height = 11.5, .dir = {0.4, 1}};
  if (variant == viscous) fluid.viscosity = 3, fluid.walls = Walls::stick;
  if (variant == semiLagrangian) fluid.advection = Advection::semiLagrangian;
  if (variant == poured) fluid.source = {0, 0.4}, fluid.sourceRadius = 0.15, fluid.sourceVelocity = {1, -2};
  if (variant == blocked) fluid.obstacle = {{0.1, -1, 0.35, 0}}, fluid.viscosity = 1;
  return fluid;
}
template <class F>
auto scene(F const& fluid) {
  return Simulation{node<"root">(Gravity{{0.5, -9.81, 0}}, node<"water">(fluid))};
}
template <class F, class Sim>
F& water(Sim& sim) {
  return sim.template at<"water">().template get<F>();
}

// how far velocities, distances and pressures are from each other, over their largest
template <class A, class B>
double apart(A const& device, B const& host) {
  auto const& a = device.flow;
  auto const& b = host.flow;
  REQUIRE(a.size() == b.size());
  const std::size_t fields = b.size() / device.grid.grid().size, n = device.grid.grid().size;
  double worst = 0;
  for (std::size_t k = 0; k < fields; ++k) {
    double most = 0, difference = 0;
    for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
      most = std::max(most, std::abs(double(b[i])));
      difference = std::max(difference, std::abs(double(a[i]) - double(b[i])));
    }
    if (most > 0) worst = std::max(worst, difference / most);
  }
  return worst;
}

template <class On, class Host>
void moves_as(On const& on, Host const& host, double tolerance) {
  auto device = scene(on), again = scene(on);
  auto processor = scene(host);
  device.init();
  again.init();
  processor.init();
  for (int k = 0; k < 20; ++k) {
    if (k == 2) gpu::transfers() = {};
    device.animate(dt);
    processor.animate(dt);
  }
  CHECK(gpu::transfers().toHost + gpu::transfers().toDevice == 0);
  On& a = water<On>(device);
  Host& b = water<Host>(processor);
  CHECK(a.kineticEnergy() == Approx(b.kineticEnergy()).epsilon(tolerance));
  CHECK(a.gravityEnergy({0, -9.81, 0}) == Approx(b.gravityEnergy({0, -9.81, 0})).epsilon(tolerance));
  CHECK(a.volume() == Approx(b.volume()).epsilon(tolerance));
  CHECK(b.kineticEnergy() > 1);
  CHECK(gpu::transfers().toHost == 0);
  CHECK(apart(a, b) < tolerance);
  CHECK(a.border().positions.size() == b.border().positions.size());
  for (int k = 0; k < 20; ++k) again.animate(dt);
  CHECK(water<On>(again).flow == a.flow);
}

// u = sin x cos y e^-2 nu t, v = -cos x sin y e^-2 nu t in a box along whose walls it slips
double vortex(int n) {
  constexpr double pi = 3.14159265358979323846, viscosity = 0.1;
  GridFluidSettings<2> settings;
  settings.cells = {n, n};
  settings.cellWidth = pi / n;
  settings.density = 1;
  settings.viscosity = viscosity;
  settings.hasSurface = false;
  settings.tolerance = 1e-8;
  GridFluid<double, 2, gpu::GridLoops> fluid;
  fluid.init("vortex", settings);
  auto of = [](int c, Eigen::Vector2d const& x) {
    return c == 0 ? std::sin(x[0]) * std::cos(x[1]) : -std::cos(x[0]) * std::sin(x[1]);
  };
  fluid.setVelocity(of);
  fluid.begin();
  const double step = 25.6 / (n * n);
  const int steps = int(std::lround(1 / step));
  for (int k = 0; k < steps; ++k) fluid.step(step, {0, 0}, {});
  double sum = 0;
  for (int c = 0; c < 2; ++c)
    fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
      Eigen::Vector2d x = fluid.centre(i);
      x[c] -= settings.cellWidth / 2;
      const double off = fluid.velocity.value[std::size_t(c)][std::size_t(i)] -
                         std::exp(-2 * viscosity * step * steps) * of(c, x);
      sum += off * off;
    });
  return std::sqrt(sum / (2.0 * n * n));
}

template <class D>
auto pool_with_box() {
  const Mesh box = shapes::box({-0.15, -0.15, -0.15}, {0.15, 0.15, 0.15});
  Rigid3d::Coord start = Rigid3d::zero();
  start.center = {0.02, 0.1, 0};
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   node<"water">(Fluid3D<D>{.nx = 14, .ny = 14, .nz = 14, .cellwidth = 0.06, .height = 7}),
                   node<"box">(EulerExplicitSolver{},
                               MechanicalObject<Rigid3d>{.position = {start}},
                               UniformMass<Rigid3d>{.vertexMass = Rigid3d::MassType{.mass = 14}},
                               node<"surface">(MeshTopology{.quads = box.quads},
                                               MechanicalObject<Vec3d>{.position = box.positions},
                                               RigidMapping<Rigid3d, Vec3d>{},
                                               ImmersedSolid<Vec3d>{})))};
}

struct Few : Registry<Gravity, Fluid3D<Vec3d>, Fluid3D<CudaVec3f>> {};
auto started(std::string const& xml) {
  auto read = parse_scene<Few>("water.scn", xml);
  Simulation<RuntimeNode<Few>> sim(std::move(read.root));
  sim.init(read.time, read.step);
  return sim;
}

}  // namespace

TEST_CASE("a fluid on a grid moves on the device as on the processor, and no field crosses in a step") {
  for (int v = 0; v < variants; ++v) {
    INFO("variant " << v);
    moves_as(tank<CudaVec3d>(v), tank<Vec3d>(v), 1e-10);
    moves_as(sheet<CudaVec2d>(v), sheet<Vec2d>(v), 1e-10);
  }
  // sums of single precision in another order change where the pressure stops, at 1e-6 of its right side
  moves_as(tank<CudaVec3f>(blocked), tank<Vec3f>(blocked), 1e-3);
  moves_as(sheet<CudaVec2f>(plain), sheet<Vec2f>(plain), 1e-3);
}

TEST_CASE("a fluid on the device starts again, and goes on from what was kept, with the same bits") {
  auto check = [](auto fluid) {
    using F = decltype(fluid);
    auto sim = scene(fluid);
    sim.init();
    for (int k = 0; k < 6; ++k) sim.animate(dt);
    F kept = fluid;
    kept.flow = water<F>(sim).flow;
    auto goesOn = scene(kept);
    goesOn.init(6 * dt, 6);
    for (int k = 0; k < 3; ++k) sim.animate(dt), goesOn.animate(dt);
    const auto nine = water<F>(sim).flow;
    CHECK(water<F>(goesOn).flow == nine);
    sim.reset();
    for (int k = 0; k < 9; ++k) sim.animate(dt);
    CHECK(water<F>(sim).flow == nine);
  };
  check(tank<CudaVec3d>(viscous));
  check(tank<CudaVec3f>(blocked));
  check(tank<Vec3f>(blocked));
}

TEST_CASE("a pool on the device rests under the pressure of its depth") {
  GridFluidSettings<3> settings;
  settings.cells = {8, 12, 10};
  settings.cellWidth = 1.0 / 12;
  settings.tolerance = 1e-8;
  GridFluid<double, 3, gpu::GridLoops> fluid;
  fluid.init("pool", settings);
  fluid.setSurface([](auto const& x) { return x[1] - 0.63; });
  fluid.begin();
  const double before = fluid.volume();
  for (int k = 0; k < 20; ++k) fluid.step(dt, {0, -9.81, 0}, {});
  double worst = 0;
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
    if (fluid.velocity.cell[std::size_t(i)] == CellKind::fluid)
      worst = std::max(worst, std::abs(fluid.pressure(i) - 9810 * (0.63 - fluid.centre(i)[1])));
  });
  CHECK(worst < 1e-5 * 9810 * 0.63);
  CHECK(fluid.volume() == Approx(before).epsilon(1e-10));
  CHECK(fluid.divergence() < 1e-6);
}

TEST_CASE("Taylor and Green's vortex on the device has order 2, in a box that is full") {
  CHECK(std::log2(vortex(16) / vortex(32)) > 1.8);
}

TEST_CASE("a flow along a periodic axis on the device is that of the processor") {
  auto run = [](auto& fluid) {
    GridFluidSettings<3> settings;
    settings.cells = {12, 10, 6};
    settings.periodic = {true, false, true};
    settings.cellWidth = 0.1;
    settings.density = 1;
    settings.viscosity = 0.1;
    settings.walls = Walls::stick;
    settings.hasSurface = false;
    fluid.init("plates", settings);
    fluid.setVelocity(
        [](int c, auto const& x) { return 0.1 * std::sin(5 * x[1] + c) * std::cos(10.5 * x[2]); });
    fluid.begin();
    for (int k = 0; k < 10; ++k) fluid.step(0.05, {1, 0, 0.2}, {});
  };
  GridFluid<double, 3> host;
  GridFluid<double, 3, gpu::GridLoops> device;
  run(host);
  run(device);
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < host.grid().size; ++i)
      worst = std::max(worst, std::abs(host.velocity.value[c][i] - device.velocity.value[c][i]));
  CHECK(worst < 1e-11);
  CHECK(host.kineticEnergy() > 0.01);
}

TEST_CASE("a body of the processor swims in a fluid of the device") {
  auto host = pool_with_box<Vec3d>();
  auto device = pool_with_box<CudaVec3d>();
  host.init();
  device.init();
  for (int k = 0; k < 20; ++k) {
    host.animate(dt);
    device.animate(dt);
  }
  auto const& a = device.at<"box">().state();
  auto const& b = host.at<"box">().state();
  CHECK((a.position[0].center - b.position[0].center).norm() < 1e-10);
  CHECK((a.velocity[0] - b.velocity[0]).norm() < 1e-9);
  CHECK(b.velocity[0].norm() > 0.1);
  CHECK(apart(water<Fluid3D<CudaVec3d>>(device), water<Fluid3D<Vec3d>>(host)) < 1e-8);
}

TEST_CASE("a fluid of a scene file is on the device where its template says so") {
  const std::string
      of = R"(nx="16" ny="14" nz="9" cellwidth="0.1" height="6.5" dir="0.4 1 0.1"/></Node></Node>)",
      from = R"(<Node gravity="0.5 -9.81 0"><Node name="water"><Fluid3D )";
  auto device = started(from + "template='CudaVec3f' " + of), host = started(from + of);
  auto typed = scene(tank<CudaVec3f>(plain));
  typed.init();
  for (int k = 0; k < 4; ++k) device.animate(dt), host.animate(dt), typed.animate(dt);
  auto* const water3f = device.root().find_node("water")->get<Fluid3D<CudaVec3f>>();
  REQUIRE(water3f);
  CHECK(host.root().find_node("water")->get<Fluid3D<Vec3d>>());
  CHECK(water3f->flow == water<Fluid3D<CudaVec3f>>(typed).flow);

  const std::string saved = scene_text(device, dt);
  CHECK_THAT(saved, Contains("template=\"CudaVec3f\""));
  auto goesOn = started(saved);
  device.animate(dt);
  goesOn.animate(dt);
  CHECK(goesOn.root().find_node("water")->get<Fluid3D<CudaVec3f>>()->flow == water3f->flow);
  CHECK_THAT(error_of([&] { started(from + "template='CudaVec3d' " + of); }),
             Contains("Fluid3D") && Contains("Vec3d, CudaVec3f"));
}

TEST_CASE("what a fluid on the device refuses") {
  auto refused = [](auto change) {
    return error_of([&] {
      auto fluid = tank<CudaVec3f>(plain);
      change(fluid);
      auto sim = scene(fluid);
      sim.init();
      sim.animate(dt);
    });
  };
  using F = Fluid3D<CudaVec3f>&;
  CHECK(refused([](F) {}).empty());
  CHECK_THAT(refused([](F f) { f.nx = f.ny = f.nz = 10000; }),
             Contains("/root/water: Fluid3D<CudaVec3f>") && Contains("would take"));
  CHECK_THAT(refused([](F f) { f.height = -3; }), Contains("there is no fluid in the grid"));
  CHECK_THAT(refused([](F f) { f.dir = {0, 0, 0}; }), Contains("dir is zero"));

  auto diverged = scene(tank<CudaVec3f>(plain));
  diverged.init();
  water<Fluid3D<CudaVec3f>>(diverged).grid.velocity.value[1][500] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THAT(error_of([&] { diverged.animate(dt); }),
             Contains("Fluid3D<CudaVec3f>") && Contains("the velocity of the fluid is not finite"));

  auto recorded = scene(tank<CudaVec3f>(plain));
  recorded.init();
  CHECK_THAT(error_of([&] { gpu::RecordedStep step(recorded, dt); }),
             Contains("Fluid3D<CudaVec3f>") && Contains("recorded step cannot"));
}

}  // namespace test_grid_fluids_on_device
