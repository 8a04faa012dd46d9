// SPDX-License-Identifier: BSL-1.0
// A fluid on a grid: orders of advection, velocities out of the fluid, solids, bits on threads, long steps,
// bad input.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/fluid/grid_fluid.hpp>

#include <cmath>
#include <memory>

namespace test_grid_fluid {

using namespace sinew;
using namespace sinew::fluid;

namespace {

constexpr double pi = 3.14159265358979323846;

// the error of a wave that a uniform flow has carried once around
double carried(int n, Advection method) {
  GridFluidSettings<2> settings;
  settings.cells = {n, 4};
  settings.periodic = {true, true};
  settings.cellWidth = 1.0 / n;
  settings.hasSurface = false;
  GridFluid<double, 2> fluid;
  fluid.init("wave", settings);
  fluid.setVelocity([](int c, auto const&) { return c == 0 ? 1.0 : 0.0; });
  fluid.begin();
  std::vector<double> wave(fluid.grid().size, 0.0), next = wave;
  AdvectionRoom<double> room;
  room.init(wave.size());
  auto of = [&](std::ptrdiff_t i) { return std::sin(2 * pi * fluid.centre(i)[0]); };
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) { wave[std::size_t(i)] = of(i); });
  fluid.grid().wrap(std::span<double>(wave));
  const int steps = n * 5 / 2;  // 0.4 cells each
  for (int k = 0; k < steps; ++k) {
    advect(
        fluid.velocity,
        -1,
        wave,
        next,
        double(n) / steps,
        method,
        room,
        {},
        [](std::ptrdiff_t) { return true; },
        [&](std::vector<double>& field) { fluid.grid().wrap(std::span<double>(field)); });
    wave.swap(next);
  }
  double sum = 0;
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) { sum += std::abs(wave[std::size_t(i)] - of(i)); });
  return sum / (4 * n);
}

// water that falls from half of a box
template <class Real, int N>
std::unique_ptr<GridFluid<Real, N>> dam(int n, Advection method = Advection::macCormack) {
  GridFluidSettings<N> settings;
  settings.cells.fill(n);
  settings.cellWidth = 1.0 / n;
  settings.advection = method;
  auto fluid = std::make_unique<GridFluid<Real, N>>();
  fluid->init("dam", settings);
  fluid->setSurface([](auto const& x) { return std::max(x[0] - 0.4, x[1] - 0.6); });
  fluid->begin();
  return fluid;
}

}  // namespace

TEST_CASE("semi-Lagrangian advection has order 1, MacCormack's 2") {
  const double first = carried(64, Advection::semiLagrangian),
               firstFine = carried(128, Advection::semiLagrangian);
  CHECK(std::log2(first / firstFine) == Approx(1).margin(0.15));
  // the limiter flattens crests, in two cells of a wave: in the mean the order stays
  const double second = carried(64, Advection::macCormack), secondFine = carried(128, Advection::macCormack);
  CHECK(std::log2(second / secondFine) > 1.8);
  CHECK(secondFine < firstFine / 20);
}

TEST_CASE("what is carried stays between the values around") {
  GridFluidSettings<2> settings;
  settings.cells = {32, 32};
  settings.cellWidth = 1.0 / 32;
  settings.hasSurface = false;
  GridFluid<double, 2> fluid;
  fluid.init("step", settings);
  fluid.setVelocity([](int c, auto const& x) {
    return c == 0 ? std::sin(pi * x[0]) * std::cos(pi * x[1]) : -std::cos(pi * x[0]) * std::sin(pi * x[1]);
  });
  fluid.begin();
  std::vector<double> field(fluid.grid().size, 0.0), next = field;
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) { field[std::size_t(i)] = fluid.centre(i)[0] < 0.5; });
  AdvectionRoom<double> room;
  room.init(field.size());
  auto fill = [&](std::vector<double>& f) { LevelSet<double, 2>::fillAround(fluid.grid(), f); };
  fill(field);
  for (int k = 0; k < 50; ++k) {
    advect(
        fluid.velocity,
        -1,
        field,
        next,
        0.7 * 32 / 32,
        Advection::macCormack,
        room,
        {},
        [](std::ptrdiff_t) { return true; },
        fill);
    field.swap(next);
  }
  for (const double value : field) {
    CHECK(value >= 0);
    CHECK(value <= 1);
  }
}

TEST_CASE("a uniform flow goes on outside the fluid, as far as the layers") {
  GridFluidSettings<2> settings;
  settings.cells = {16, 16};
  settings.periodic = {true, false};
  settings.cellWidth = 0.1;
  GridFluid<double, 2> fluid;
  fluid.init("uniform", settings);
  fluid.setSurface([](auto const& x) { return x[1] - 0.42; });
  fluid.setVelocity([](int c, auto const&) { return c == 0 ? 2.0 : 0.0; });
  fluid.begin();
  for (double y = 0.05; y < 0.7; y += 0.1) CHECK(fluid.velocityAt({0.33, y})[0] == Approx(2).epsilon(1e-14));
  CHECK(fluid.velocityAt({0.33, 1.55})[0] == 0);
}

TEST_CASE("a redistanced surface is a distance, and stays where it was") {
  GridFluidSettings<3> settings;
  settings.cells = {32, 32, 32};
  settings.cellWidth = 1.0 / 32;
  GridFluid<double, 3> fluid;
  fluid.init("ball", settings);
  const Eigen::Vector3d middle(0.52, 0.47, 0.5);
  // slope 4 and more: it is made a distance
  fluid.setSurface([&](Eigen::Vector3d const& x) {
    const double d = (x - middle).norm() - 0.3;
    return 4 * d * (1 + d);
  });
  double worst = 0;
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
    const double d = ((fluid.centre(i) - middle).norm() - 0.3) * 32;
    if (std::abs(d) < 4) worst = std::max(worst, std::abs(fluid.surface.value[std::size_t(i)] - d));
  });
  CHECK(worst < 0.35);  // [cells] upwind of first order
  double nearest = 0;
  fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
    const double d = ((fluid.centre(i) - middle).norm() - 0.3) * 32;
    if (std::abs(d) < 0.5) nearest = std::max(nearest, std::abs(fluid.surface.value[std::size_t(i)] - d));
  });
  CHECK(nearest < 0.1);
  CHECK(fluid.volume() == Approx(4 * pi / 3 * 0.027).epsilon(0.01));
}

TEST_CASE("no fluid goes into solids, and none is lost") {
  for (const Walls walls : {Walls::slip, Walls::stick}) {
    GridFluidSettings<2> settings;
    settings.cells = {32, 24};
    settings.cellWidth = 1.0 / 32;
    settings.walls = walls;
    settings.viscosity = walls == Walls::stick ? 1 : 0;
    GridFluid<double, 2> fluid;
    fluid.init("step", settings);
    fluid.setSolids([](auto const& x) { return x[0] > 0.5 && x[0] < 0.7 && x[1] < 0.2; });
    fluid.setSurface([](auto const& x) { return std::max(x[0] - 0.3, x[1] - 0.5); });
    fluid.begin();
    const double before = fluid.volume();
    for (int k = 0; k < 120; ++k) {
      fluid.step(0.01, {0, -9.81}, {});
      REQUIRE(fluid.pressureSolve.converged);
      CHECK(fluid.volume() == Approx(before).epsilon(1e-8));
    }
    fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
      for (std::size_t c = 0; c < 2; ++c)
        if (fluid.velocity.kind[c][std::size_t(i)] == FaceKind::wall)
          CHECK(fluid.velocity.value[c][std::size_t(i)] == 0);
    });
    CHECK(fluid.kineticEnergy() > 0);
    // it has come over the step
    double beyond = 0;
    fluid.grid().forCells({}, [&](std::ptrdiff_t i) {
      if (fluid.centre(i)[0] > 0.7) beyond += fluid.surface.fraction(i);
    });
    CHECK(beyond > 1);
  }
}

TEST_CASE("a fluid on a grid has the same bits on any number of threads") {
  auto run = [](Workers* workers) {
    auto fluid = dam<double, 3>(18);
    for (int k = 0; k < 12; ++k) fluid->step(0.01, {0, -9.81, 0}, {workers});
    std::vector<double> all;
    fluid->save(all, {workers});
    return all;
  };
  Workers two(2), three(3);
  const auto one = run(nullptr);
  CHECK(run(&two) == one);
  CHECK(run(&three) == one);
}

TEST_CASE("a fluid goes on from what was saved with the same bits") {
  auto fluid = dam<double, 2>(24);
  for (int k = 0; k < 10; ++k) fluid->step(0.01, {0, -9.81}, {});
  std::vector<double> kept, a, b;
  fluid->save(kept, {});
  GridFluid<double, 2> other;
  other.init("other", fluid->settings());
  REQUIRE(other.saves(kept));
  other.restore(kept);
  for (int k = 0; k < 10; ++k) {
    fluid->step(0.01, {0, -9.81}, {});
    other.step(0.01, {0, -9.81}, {});
  }
  fluid->save(a, {});
  other.save(b, {});
  CHECK(a == b);

  GridFluidSettings<2> turned = fluid->settings();
  turned.cells = {11, 50};  // as many values
  GridFluid<double, 2> another;
  another.init("another", turned);
  CHECK_FALSE(another.saves(kept));
  kept[5] = std::nan("");
  CHECK_FALSE(other.saves(kept));
}

TEST_CASE("steps far beyond the CFL limit are stable") {
  // what is lost: at 40 times the step the same water has less energy, and is smoother
  for (const Advection method : {Advection::semiLagrangian, Advection::macCormack}) {
    auto fluid = dam<double, 2>(32, method);
    const double start = fluid->gravityEnergy({0, -9.81}), volume = fluid->volume();
    double most = 0;
    for (int k = 0; k < 40; ++k) {
      fluid->step(0.1, {0, -9.81}, {});
      most = std::max(most, fluid->courant);
      CHECK(fluid->kineticEnergy() < start);
      CHECK(fluid->divergence() < 1);  // [1/s] of a velocity of some 100 cells/s
    }
    CHECK(most > 4);
    CHECK(fluid->volume() == Approx(volume).epsilon(0.05));
  }
}

TEST_CASE("a source pours what it says") {
  GridFluidSettings<2> settings;
  settings.cells = {32, 32};
  settings.cellWidth = 1.0 / 32;
  GridFluid<double, 2> fluid;
  fluid.init("pool", settings);
  fluid.setSurface([](auto const& x) { return x[1] - 0.2; });
  fluid.begin();
  const double before = fluid.volume();
  fluid.pour([](auto const& x) { return (x - Eigen::Vector2d(0.5, 0.7)).norm() - 0.1; }, {0, -1}, {});
  CHECK(fluid.volume() - before == Approx(pi * 0.01).epsilon(0.02));
  const double poured = fluid.volume();
  for (int k = 0; k < 40; ++k) fluid.step(0.005, {0, -9.81}, {});
  CHECK(fluid.volume() == Approx(poured).epsilon(1e-8));
}

TEST_CASE("a grid in single precision") {
  auto fluid = dam<float, 3>(16);
  for (int k = 0; k < 20; ++k) fluid->step(0.01, {0, -9.81, 0}, {});
  CHECK(std::isfinite(fluid->kineticEnergy()));
  CHECK(fluid->kineticEnergy() > 0);
}

TEST_CASE("what a grid of a fluid refuses") {
  auto refused = [](auto change) {
    return error_of([&] {
      GridFluidSettings<3> settings;
      settings.cells = {8, 8, 8};
      change(settings);
      GridFluid<double, 3> fluid;
      fluid.init("pool", settings);
      fluid.setSurface([&](auto const& x) { return x[1] - 3 + 1000 * (settings.density < 1); });
      fluid.begin();
      fluid.setVelocity([&](int, auto const&) { return settings.density > 5000 ? std::nan("") : 0.0; });
      fluid.step(0.01, {0, -9.81, 0}, {});
    });
  };
  using S = GridFluidSettings<3>&;
  CHECK_THAT(refused([](S s) {
               s.cells = {10000, 10000, 10000};
             }),
             Catch::Contains("would take") && Catch::Contains("make it coarser"));
  CHECK_THAT(refused([](S s) {
               s.cells = {2147483645, 2147483645, 2147483645};
             }),
             Catch::Contains("would take"));
  CHECK_THAT(refused([](S s) { s.cells[1] = 0; }), Catch::Contains("there are 0 cells inside"));
  CHECK_THAT(refused([](S s) { s.periodic[2] = true, s.cells[2] = 9; }),
             Catch::Contains("take an even number"));
  CHECK_THAT(refused([](S s) { s.density = 0.5; }), Catch::Contains("there is no fluid in the grid"));
  CHECK_THAT(refused([](S s) { s.density = 6000; }),
             Catch::Contains("the velocity of the fluid is not finite"));
}

}  // namespace test_grid_fluid
