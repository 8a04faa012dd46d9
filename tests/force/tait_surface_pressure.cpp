// SPDX-License-Identifier: BSL-1.0
// What a closed surface holds: pressures in closed form, energy and slopes by differences.
#include "one_component.hpp"

#include <sinew/force/tait_surface_pressure.hpp>

#include <cmath>

namespace test_tait_surface_pressure {

using namespace sinew;
using Tait = TaitSurfacePressureForceField<Vec3d>;

namespace {

// a box of 2 x 3 x 4 m, its quads counter-clockwise from outside
Vec3d::VecCoord corners(double scale = 1) {
  Vec3d::VecCoord x;
  for (int k = 0; k < 8; ++k)
    x.push_back(Eigen::Vector3d(5, 0, 0) +
                scale * Eigen::Vector3d(k & 1 ? 2 : 0, k & 2 ? 3 : 0, k & 4 ? 4 : 0));
  return x;
}
const std::vector<Quad> sides{
    {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};

Tait made(Tait tait) { return one::ready(tait, corners(), {.quads = sides}); }

}  // namespace

TEST_CASE("a box that holds a gas has the pressure of Tait's equation") {
  for (const double gamma : {1., 1.4, 5.}) {
    auto tait = made({.p0 = 7, .B = 100, .gamma = gamma});
    CHECK(tait.initialVolume == Approx(24));
    auto f = one::force(tait, corners());
    CHECK(tait.pressure == Approx(7));
    // scaled by a half along each axis
    f = one::force(tait, corners(0.5));
    const double p = 7 - 100 * (std::pow(0.125, gamma) - 1);
    CHECK(tait.volume == Approx(3));
    CHECK(tait.pressure == Approx(p));
    // the load on a side is p times its area
    double along = 0;
    for (std::size_t k = 0; k < 8; ++k)
      if (k & 1) along += f[k][0];
    CHECK(along == Approx(p * 1.5 * 2));
    Eigen::Vector3d sum(0, 0, 0);
    for (auto const& one : f) sum += one;
    CHECK(sum.norm() < 1e-12 * std::abs(p));
  }
  auto constant = made({.p0 = 7});
  one::force(constant, corners(0.5));
  CHECK(constant.pressure == 7);
}

TEST_CASE("forces of a gas are slopes of its energy, and the tangent theirs") {
  auto tait = made({.p0 = 3, .B = 50, .gamma = 2.5});
  auto x = corners();
  for (std::size_t k = 0; k < 8; ++k)
    x[k] +=
        0.3 * Eigen::Vector3d(std::sin(3. * double(k)), std::cos(5. * double(k)), std::sin(7. * double(k)));
  const auto f = one::force(tait, x);
  Vec3d::VecDeriv u;
  for (std::size_t k = 0; k < 8; ++k) u.push_back({std::cos(double(k)), std::sin(2. * double(k)), 0.3});
  const auto ku = one::product(tait, u, 1, 0);
  const double h = 1e-5;
  auto moved = [&](double by) {
    auto y = x;
    for (std::size_t k = 0; k < 8; ++k) y[k] += by * u[k];
    return y;
  };
  double power = 0;
  for (std::size_t k = 0; k < 8; ++k) power += f[k].dot(u[k]);
  // central differences: truncation h^2, rounding 1e-16 E / h
  CHECK((tait.potentialEnergy(moved(-h)) - tait.potentialEnergy(moved(h))) / (2 * h) ==
        Approx(power).epsilon(1e-7));
  const auto plus = one::force(tait, moved(h)), minus = one::force(tait, moved(-h));
  for (std::size_t k = 0; k < 8; ++k)
    CHECK(((plus[k] - minus[k]) / (2 * h) - ku[k]).norm() < 1e-6 * (1 + ku[k].norm()));
}

TEST_CASE("volume is injected at a rate, and a reset takes it back") {
  auto tait = made({.B = 100, .gamma = 1, .injectedVolume = 6, .maxInjectionRate = 4});
  auto step = [&] {
    StepAhead ahead{};
    ahead.dt = 1;
    tait.beginStep(ahead, 0);
  };
  step();
  CHECK(tait.currentInjectedVolume == 4);
  step();
  CHECK(tait.currentInjectedVolume == 6);
  one::force(tait, corners());
  CHECK(tait.pressure == Approx(-100 * (24. / 30 - 1)));
  tait.injectedVolume = 1;
  step();
  CHECK(tait.currentInjectedVolume == 2);
  tait.reset();
  CHECK(tait.currentInjectedVolume == 0);
}

TEST_CASE("a surface that holds nothing is refused") {
  auto refuses = [](Tait tait, std::vector<Quad> const& of, std::initializer_list<std::string_view> words) {
    one::refuses(tait, corners(), {.quads = of}, words);
  };
  refuses({}, {}, {"body: TaitSurfacePressureForceField<Vec3d>", "neither triangle nor quad"});
  auto open = sides;
  open.pop_back();
  refuses({}, open, {"has a border"});
  auto inside = sides;
  for (auto& q : inside) std::swap(q[1], q[3]);
  refuses({}, inside, {"the surface holds -24 m^3", "counter-clockwise"});
  refuses({.injectedVolume = -24}, sides, {"-24 m^3 are injected"});
  refuses({.B = -1}, sides, {"B is -1 Pa"});
  // turned inside out in a step, it pushes as if there were no room left
  auto tait = made({.p0 = 1, .B = 100, .gamma = 1.5});
  one::force(tait, corners(-1));
  CHECK(tait.pressure == 101);
  CHECK(tait.slope == 0);
}

}  // namespace test_tait_surface_pressure
