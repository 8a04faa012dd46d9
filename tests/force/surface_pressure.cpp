// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/surface_pressure.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_surface_pressure {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Pressure = SurfacePressureForceField<Vec3d>;

const Vec3d::VecCoord corners{
    {0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}};
const std::vector<Quad> box{
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};
const std::vector<Triangle> lid{{4, 5, 6}, {4, 6, 7}};

Vector3d sum(Vec3d::VecDeriv const& f) {
  Vector3d s = Vector3d::Zero();
  for (auto const& fi : f) s += fi;
  return s;
}

}  // namespace

TEST_CASE("the load on a face is pressure times area along its normal") {
  for (auto const& topology :
       {TopologyView{.triangles = lid}, TopologyView{.quads = std::span(box).subspan(1, 1)}}) {
    auto pressure = ready(Pressure{.pressure = 7}, corners, topology);
    CHECK_FALSE(pressure.properties().conservative);
    const auto f = force(pressure, corners);
    CHECK((sum(f) - Vector3d(0, 0, 7 * 6)).norm() < 1e-13);
    // 4 and 6 are in both triangles of three square metres: a third of each
    CHECK((f[4] - Vector3d(0, 0, 14)).norm() < 1e-13);
    CHECK((f[5] - Vector3d(0, 0, 7)).norm() < 1e-13);
  }
}

TEST_CASE("pressure in a closed surface works as volume grows") {
  auto pressure = ready(Pressure{.pressure = 7}, corners, {.quads = box});
  CHECK(pressure.properties().conservative);
  CHECK(sum(force(pressure, corners)).norm() < 1e-13);
  CHECK(potential_energy(pressure, corners) == Approx(0).margin(1e-13));
  Vec3d::VecCoord larger = corners;
  for (auto& x : larger) x = 2 * x + Vector3d(5, 6, 7);
  CHECK(potential_energy(pressure, larger) == Approx(-7 * (48 - 6)));
  pressure.pressure = 1;  // and may change
  CHECK(potential_energy(pressure, larger) == Approx(-42));
}

TEST_CASE("the tangent is the symmetric part of the derivative on an open surface") {
  auto pressure = ready(Pressure{.pressure = 7}, corners, {.triangles = std::span(lid).first(1)});
  Vec3d::VecCoord x = corners;
  x[4] += Vector3d(0.1, 0.2, 0.3);
  // the force is quadratic in x: central differences are exact to rounding
  Eigen::Matrix<double, 9, 9> derivative, tangent;
  for (int j = 0; j < 9; ++j) {
    Vec3d::VecDeriv dx(corners.size(), Vector3d::Zero());
    dx[std::size_t(4 + j / 3)][j % 3] = 1;
    Vec3d::VecCoord plus = x, minus = x;
    for (std::size_t i = 0; i < x.size(); ++i) plus[i] += dx[i], minus[i] -= dx[i];
    const auto f = force(pressure, plus), g = force(pressure, minus);
    force(pressure, x);
    const auto df = one::product(pressure, dx, 1, 0);
    for (int i = 0; i < 9; ++i) {
      derivative(i, j) = (f[std::size_t(4 + i / 3)][i % 3] - g[std::size_t(4 + i / 3)][i % 3]) / 2;
      tangent(i, j) = df[std::size_t(4 + i / 3)][i % 3];
    }
  }
  CHECK((tangent - 0.5 * (derivative + derivative.transpose())).norm() < 1e-13 * derivative.norm());
  CHECK(tangent.norm() > 1);
}

TEST_CASE("pressure may be on chosen elements, or on those in a box") {
  auto loaded = [](Pressure p) {
    p = ready(p, corners, {.triangles = lid, .quads = box});
    return force(p, corners);
  };
  CHECK((sum(loaded({.pressure = 1, .triangleIndices = {1}, .quadIndices = {0}})) - Vector3d(0, 0, 3 - 6))
            .norm() < 1e-13);
  CHECK((sum(loaded({.pressure = 1, .min = {{-1, -1, -1}}, .max = {{3, 4, 0.5}}})) - Vector3d(0, 0, -6))
            .norm() < 1e-13);
  CHECK((sum(loaded({.pressure = 1, .min = {{-1, -1, 0.5}}})) - Vector3d(0, 0, 12)).norm() < 1e-13);
}

TEST_CASE("a pressure in pulses rises and falls between its bounds") {
  auto values = [](Pressure p, int steps) {
    std::vector<double> all;
    for (int i = 0; i < steps; ++i) {
      p.beginStep({i + 1, 0.25 * i, 0.25 * (i + 1), 0.25, true}, 0);
      all.push_back(p.currentPressure());
    }
    p.reset();
    CHECK(p.currentPressure() == 0);
    return all;
  };
  CHECK(values({.pressure = 5, .pulseMode = true, .pressureSpeed = 8}, 7) ==
        std::vector<double>{2, 4, 5, 3, 1, 0, 2});
  CHECK(values({.pressure = 5, .pulseMode = true, .pressureSpeed = 8, .pressureLowerBound = 3}, 6) ==
        std::vector<double>{2, 4, 5, 3, 5, 3});
  CHECK(values({.pressure = -4, .pulseMode = true, .pressureLowerBound = 1}, 11) ==
        std::vector<double>{-1, -2, -3, -4, -3, -2, -1, 0, 1, 0, -1});
  // that is what acts
  auto lifted = ready(Pressure{.pressure = 8, .pulseMode = true}, corners, {.triangles = lid});
  CHECK(sum(force(lifted, corners)).norm() == 0);
  lifted.beginStep({1, 0, 0.25, 0.25, true}, 0);
  CHECK((sum(force(lifted, corners)) - Vector3d(0, 0, 2 * 6)).norm() < 1e-13);
  refuses(Pressure{.pressureSpeed = -1}, corners, {.triangles = lid}, {"pressureSpeed is -1 Pa/s"});
}

TEST_CASE("pressure refuses what has no surface") {
  refuses(Pressure{}, corners, {}, {"body", "SurfacePressureForceField<Vec3d>", "neither triangle nor quad"});
  refuses(Pressure{.triangleIndices = {2}},
          corners,
          {.triangles = lid},
          {"triangleIndices has 2", "2 such elements"});
  refuses(Pressure{.quadIndices = {0}}, corners, {.triangles = lid}, {"quadIndices has 0"});
  refuses(Pressure{.pressure = one::notANumber}, corners, {.triangles = lid}, {"pressure is nan"});
  const std::vector<Triangle> far{{0, 1, 8}};
  refuses(Pressure{}, corners, {.triangles = far}, {"triangle 0 refers to point 8", "8 points"});
}

}  // namespace test_surface_pressure
