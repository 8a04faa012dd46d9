// SPDX-License-Identifier: BSL-1.0
#include <sinew/force/stiff_spring.hpp>

#include "contact_scene.hpp"
#include "scene/reset.hpp"

namespace test_friction {

using namespace sinew;

namespace {

constexpr double dt = 0.01, mass = 0.5;

// a block of four points, or of a cube of eight that are joined by springs, on a slope; without springs all
// points do the same, and the block slides as a whole. `ratio`: k dt^2/m.
auto block_on_slope(double friction, double angle, double ratio = 2, double damping = 10, bool cube = false,
                    double up = 0.099) {
  const double c = std::cos(angle), s = std::sin(angle), k = ratio * mass / (dt * dt), limit = 0.1;
  std::vector<Eigen::Vector3d> p;
  for (const double z : {0.0, 1.0})
    for (auto [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      if (z == 0 || cube) p.push_back({c * x - s * (z + up), y, s * x + c * (z + up)});
  StiffSpringForceField<Vec3d> springs;
  for (int i = 0; cube && i < 8; ++i)
    for (int j = i + 1; j < 8; ++j)
      springs.springs.push_back({i, j, 1000, 1, (p[std::size_t(i)] - p[std::size_t(j)]).norm()});
  return contact_scene(
      MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = limit},
      10,
      floor_node(k * limit, friction, angle),
      node<"block">(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 200, .tolerance = 1e-14},
                    MechanicalObject<Vec3d>{.position = p},
                    UniformMass<Vec3d>{.vertexMass = mass},
                    springs,
                    PointCollisionModel<Vec3d>{.contactStiffness = 1, .contactDamping = damping}));
}

}  // namespace

TEST_CASE("on a slope friction holds up to the angle of Coulomb, and not beyond") {
  const double friction = 0.5, critical = std::atan(friction);
  SECTION("below") {
    auto sim = block_on_slope(friction, critical - 0.01);
    sim.init();
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const auto settled = sim.at<"block">().state().position;
    for (int i = 0; i < 2000; ++i) sim.animate(0.01);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK((sim.at<"block">().state().position[i] - settled[i]).norm() < 1e-6);
  }
  SECTION("above") {
    const double angle = critical + 0.02;
    auto sim = block_on_slope(friction, angle);
    sim.init();
    // a = g (sin - mu cos), from rest
    const double a = 10 * (std::sin(angle) - friction * std::cos(angle));
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v0 = sim.at<"block">().state().velocity[0].norm();
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v1 = sim.at<"block">().state().velocity[0].norm();
    CHECK((v1 - v0) / 2 == Approx(a).epsilon(0.01));
  }
}

TEST_CASE("stiff or soft, a block holds below the angle of Coulomb and slides as it should above", "[long]") {
  const double friction = 0.5, critical = std::atan(friction);
  for (const double ratio : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
    INFO(ratio);
    for (const bool cube : {false, true})
      for (const double damping : {0.0, 10.0}) {
        INFO(cube << " " << damping);
        // dropped from 1 cm it comes to rest; once it sticks nothing moves what friction holds to, and the
        // springs go to their rest as implicit Euler has it, slowest at ratio 0.1: the cube by half as much
        // every 0.3 s
        auto sim = block_on_slope(friction, critical - 0.01, ratio, damping, cube, 0.11);
        sim.init();
        const bool slow = ratio < 1;
        for (int i = 0; i < (slow ? 1200 : 600); ++i) sim.animate(dt);
        const auto settled = sim.at<"block">().state().position;
        for (int i = 0; i < 1000; ++i) sim.animate(dt);
        auto const& x = sim.at<"block">().state().position;
        for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - settled[i]).norm() < (slow ? 1e-5 : 1e-9));
      }
    const double angle = critical + 0.02, a = 10 * (std::sin(angle) - friction * std::cos(angle));
    auto sim = block_on_slope(friction, angle, ratio, 10);
    sim.init();
    for (int i = 0; i < 200; ++i) sim.animate(dt);
    const double v0 = sim.at<"block">().state().velocity[0].norm();
    for (int i = 0; i < 200; ++i) sim.animate(dt);
    const double v1 = sim.at<"block">().state().velocity[0].norm();
    CHECK((v1 - v0) / 2 == Approx(a).epsilon(0.002));
  }
}

TEST_CASE("friction of an impact takes energy, and what it brings to rest does not turn back") {
  // four points without springs hit a level floor at 1 m/s, and go along it at `speed`
  const double friction = 0.5;
  for (const double ratio : {1.0, 10.0, 1000.0})
    for (const double speed : {0.01, 0.1, 0.4, 2.0}) {
      INFO(ratio << " " << speed);
      auto sim = block_on_slope(friction, 0, ratio, 0, false, 0.104);
      sim.init();
      auto const& v = sim.at<"block">().state().velocity;
      for (auto& each : sim.at<"block">().state().velocity) each = {speed, 0, -1};
      double slowest = speed;
      for (int i = 0; i < 20; ++i) {
        sim.animate(dt);
        CHECK(v[0][0] <= speed * (1 + 1e-12));
        slowest = std::min(slowest, v[0][0]);
      }
      // Coulomb takes at most mu times what the floor gives against the fall; with gravity, and the spring
      // that may give back all of it
      CHECK(slowest > std::max(-2 * friction * 10 * dt, speed - friction * (2 + 10 * 20 * dt)));
      if (ratio >= 10 && speed == 2.0) {
        // the impulse is 1 m/s and g t, a step late; a division takes less than a subtraction:
        // v/(1 + a/v) > v - a by a^2/v at most
        const double coulomb = speed - friction * (1 + 10 * 20 * dt);
        CHECK(v[0][0] > coulomb - 1e-9);
        CHECK(v[0][0] < coulomb + friction * 10 * dt + friction * friction / (speed - friction));
      }
    }
}

TEST_CASE("friction of what is deep already when it is found slows it, and does not throw it back") {
  // 1 cm deep, N = k 0.01 m at the start of the step is (1 + k dt^2/m) times that of its end
  for (const double ratio : {1.0, 10.0, 1000.0})
    for (const double speed : {0.01, 0.4, 5.0}) {
      INFO(ratio << " " << speed);
      auto sim = block_on_slope(0.5, 0, ratio, 0, false, 0.09);
      sim.init();
      auto const& v = sim.at<"block">().state().velocity;
      for (auto& each : sim.at<"block">().state().velocity) each = {speed, 0, -1};
      for (int i = 0; i < 5; ++i) {
        sim.animate(dt);
        // the spring of what sticks at once swings back with what it took up
        CHECK(v[0][0] >= (speed == 5 ? -1e-3 : -1) * speed);
        CHECK(v[0][0] <= speed);
      }
    }
}

TEST_CASE("contacts, and the friction that they remember, go with a reset") {
  comes_back(block_on_slope(0.5, std::atan(0.5) - 0.01, 2, 10, true, 0.11), {1, 5, 60}, 60);
}

}  // namespace test_friction
