// SPDX-License-Identifier: BSL-1.0
// Drag by viscosity on solids in fluids on grids: arrays of cylinders and spheres, momentum, light bodies.
#include "catch.hpp"
#include "immersed_shapes.hpp"

#include <sinew/fluid/grid_fluid.hpp>

#include <numbers>

namespace test_wall_drag {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double pi = std::numbers::pi, rho = 1000, mu = 10;

ImmersedBody circle(double radius, Eigen::Vector2d const& centre) {
  ImmersedBody body;
  body.dimension = 2;
  const int n = 256;
  for (int k = 0; k < n; ++k) {
    const double turn = 2 * pi * k / n;
    body.elements.push_back({k, (k + 1) % n, -1});
    body.positions.emplace_back(centre[0] + radius * std::cos(turn), centre[1] + radius * std::sin(turn), 0);
  }
  body.velocities.assign(body.positions.size(), Vector3d::Zero());
  body.centre << centre, 0;
  return body;
}
ImmersedBody sphere(double radius, Vector3d const& centre) {
  const Mesh mesh = shapes::sphere(radius, 3, centre);
  ImmersedBody body;
  body.elements.assign(mesh.triangles.begin(), mesh.triangles.end());
  body.positions = mesh.positions;
  body.velocities.assign(body.positions.size(), Vector3d::Zero());
  body.centre = centre;
  return body;
}

/// A fluid without a surface in a periodic box of the length 1, so many cells across.
template <int N>
fluid::GridFluid<double, N> periodic(int cells) {
  fluid::GridFluidSettings<N> settings;
  settings.cells.fill(cells);
  settings.periodic.fill(true);
  settings.cellWidth = 1. / cells;
  settings.density = rho;
  settings.viscosity = mu;
  settings.walls = fluid::Walls::stick;
  settings.hasSurface = false;
  settings.tolerance = 1e-7;
  fluid::GridFluid<double, N> water;
  water.init("periodic", settings);
  water.begin();
  return water;
}
/// Of the whole box, solids at rest.
template <int N>
double mean_speed(fluid::GridFluid<double, N> const& water) {
  double sum = 0;
  water.grid().forCells({}, [&](std::ptrdiff_t i) {
    sum += water.cut.open[0][std::size_t(i)] * water.velocity.value[0][std::size_t(i)];
  });
  return sum * water.cellVolume();
}

/// The speed of a flow along x through an array that stands, driven by an acceleration so small that nothing
/// is carried along; over mu / F.
template <int N>
double mobility(int cells, ImmersedBody const& body) {
  auto water = periodic<N>(cells);
  water.bodies = {body};
  water.reserveForBodies();
  const double h = 1. / cells, dt = h * h * rho / mu, drive = 1e-9;
  double before = 0;
  for (int k = 0; k < 100000; ++k) {
    water.step(dt, Eigen::Matrix<double, N, 1>::Unit(0) * drive, {});
    const double now = mean_speed(water);
    if (k > 20 && std::abs(now - before) < 1e-5 * now) break;
    before = now;
  }
  // what the fluid is driven by it gives to the body
  double room = 0;
  water.grid().forCells({}, [&](std::ptrdiff_t i) { room += water.cut.open[0][std::size_t(i)]; });
  CHECK(water.bodies[0].load[0] == Approx(rho * drive * room * water.cellVolume()).epsilon(0.02));
  return before * mu / (rho * drive);
}

}  // namespace

TEST_CASE("a flow through an array of cylinders has the drag of Sangani and Acrivos, with the second order") {
  // F / (mu U) = 4 pi / (-ln(c)/2 - 0.738 + c - 0.887 c^2 + 2.038 c^3) of a length (1982), c the part of the
  // room that cylinders take; with steps of h^2 / nu, which pressure and viscosity split
  const double a = 0.2, c = pi * a * a;
  const double expected = (-std::log(c) / 2 - 0.738 + c - 0.887 * c * c + 2.038 * c * c * c) / (4 * pi);
  const ImmersedBody body = circle(a, {0.513, 0.487});
  const double coarse = mobility<2>(16, body) / expected - 1, fine = mobility<2>(32, body) / expected - 1;
  CAPTURE(coarse, fine);
  CHECK(std::abs(coarse) < 0.2);  // 6 cells across
  CHECK(std::abs(fine) < std::abs(coarse) / 3);
}

TEST_CASE("a flow through an array of spheres has the drag of Hasimoto", "[long]") {
  // F = 6 pi mu a U / (1 - 1.7601 c^(1/3) + c - 1.5593 c^2) (1959)
  const double a = 0.2, c = 4 * pi / 3 * a * a * a;
  const double expected = (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c) / (6 * pi * a);
  CHECK(mobility<3>(16, sphere(a, {0.513, 0.487, 0.505})) == Approx(expected).epsilon(0.2));
}

TEST_CASE("a solid of a fiftieth of the fluid's density drifts by its force and its drag", "[long]") {
  // A force F on it, and the opposite on the fluid: at last it goes through the fluid as that goes through an
  // array that stands under a gradient of pressure of F over the room of the fluid.
  const int cells = 32;
  const double a = 0.2, h = 1. / cells, dt = h * h * rho / mu / 4, force = 1e-6;
  ImmersedBody body = circle(a, {0.513, 0.487});
  const double speed = mobility<2>(cells, body) / mu;
  const double mass = 0.02 * rho * pi * a * a, inertia = mass * a * a / 2;
  body.rigid = true;
  body.response.diagonal() << 1 / mass, 1 / mass, 0, 0, 0, 1 / inertia;
  auto water = periodic<2>(cells);
  water.bodies = {body};
  water.reserveForBodies();
  double room = 0;
  water.grid().forCells({}, [&](std::ptrdiff_t i) { room += water.cut.open[0][std::size_t(i)] * h * h; });
  double drift = 0;
  for (int k = 0; k < 1600; ++k) {
    water.bodies[0].motion[0] += force * dt / mass;
    water.step(dt, {-force / (rho * room), 0}, {});
    drift = water.bodies[0].motion[0];
  }
  double mean = 0;
  water.grid().forCells({}, [&](std::ptrdiff_t i) {
    const double open = water.cut.open[0][std::size_t(i)];
    mean += (open * water.velocity.value[0][std::size_t(i)] + (1 - open) * drift) * h * h;
  });
  // pressure acts behind viscosity, in a layer of sqrt(nu dt) = h / 2 on both sides
  CHECK(drift - mean == Approx(speed * force / room).epsilon(h / a));
  CHECK(water.bodies[0].load[0] == Approx(-force).epsilon(1e-3));
}

TEST_CASE("what drag takes from a solid the fluid has") {
  for (const int cells : {16, 32}) {
    const double h = 1. / cells, a = 0.2;
    ImmersedBody body = circle(a, {0.513, 0.487});
    const double mass = 2 * rho * pi * a * a;
    body.rigid = true;
    body.response.diagonal() << 1 / mass, 1 / mass, 0, 0, 0, 0;
    body.motion[0] = 1e-9;
    auto water = periodic<2>(cells);
    water.bodies = {body};
    water.reserveForBodies();
    for (int k = 0; k < 20; ++k) water.step(h * h * rho / mu, {0, 0}, {});
    double carried = 0;
    water.grid().forCells({}, [&](std::ptrdiff_t i) {
      carried += rho * h * h * water.cut.open[0][std::size_t(i)] * water.velocity.value[0][std::size_t(i)];
    });
    // the equations of viscosity count faces whole that a solid cuts
    CHECK(mass * water.bodies[0].motion[0] + carried == Approx(mass * 1e-9).epsilon(0.02));
    CHECK(carried > 0.1 * mass * 1e-9);
  }
}

}  // namespace test_wall_drag
