// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>

namespace test_damp_velocity {

using namespace sinew;

TEST_CASE("without forces DampVelocitySolver lets velocities decay, and positions go on by them") {
  const double rate = 2, h = 0.01;
  RegistryScene sim{
      node<"root">(EulerExplicitSolver{},
                   DampVelocitySolver{.rate = rate},
                   MechanicalObject<Vec2d>{.position = {{1, 2}, {3, 4}}, .velocity = {{1, -2}, {0.5, 0}}},
                   UniformMass<Vec2d>{.vertexMass = 1},
                   Gravity{{0, 0, 0}})};
  sim.init();
  for (int i = 0; i < 50; ++i) sim.animate(h);
  auto const& state = sim.root().state();
  CHECK((state.velocity[0] - std::exp(-1.) * Eigen::Vector2d(1, -2)).norm() < 1e-14);
  // each step moves by the velocity that the step before has left: a geometric series
  const double way = h * (1 - std::exp(-1.)) / (1 - std::exp(-rate * h));
  CHECK((state.position[1] - Eigen::Vector2d(3 + 0.5 * way, 4)).norm() < 1e-14);
}

TEST_CASE("behind another solver it slows what that one moves: a fall to g h / (e^(rate h) - 1)") {
  const double rate = 3, h = 0.01, g = 10;
  RegistryScene sim{node<"root">(Gravity{{0, -g, 0}},
                                 EulerExplicitSolver{},
                                 DampVelocitySolver{.rate = rate},
                                 MechanicalObject<Rigid3d>{.position = {{}}},
                                 UniformMass<Rigid3d>{.vertexMass = {{}}})};
  sim.init();
  double v = 0, y = 0;
  for (int i = 0; i < 2000; ++i) {
    sim.animate(h);
    v -= g * h;
    y += h * v;  // before the velocity is damped
    v *= std::exp(-rate * h);
  }
  auto const& state = sim.root().state();
  CHECK(state.velocity[0][1] == Approx(v).epsilon(1e-12));
  CHECK(state.position[0].center[1] == Approx(y).epsilon(1e-12));
  CHECK(v == Approx(-g * h / (std::exp(rate * h) - 1)).epsilon(1e-12));
}

TEST_CASE("points slower than the threshold stand still; a velocity that is prescribed stays") {
  RegistryScene sim{
      node<"root">(EulerImplicitSolver{},
                   CGLinearSolver<>{},
                   DampVelocitySolver{.rate = 0, .threshold = 0.1},
                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                                           .velocity = {{0.05, 0.05, 0.05}, {0.07, 0.07, 0.07}, {0, 0, 0}}},
                   UniformMass<Vec3d>{.vertexMass = 1},
                   LinearVelocityConstraint<Vec3d>{
                       .indices = {2}, .keyTimes = {0, 10}, .velocities = {{0.01, 0, 0}, {0.01, 0, 0}}},
                   Gravity{{0, 0, 0}})};
  sim.init();
  sim.animate(0.01);
  auto const& v = sim.root().state().velocity;
  CHECK(v[0] == Eigen::Vector3d::Zero());
  CHECK((v[1] - Eigen::Vector3d::Constant(0.07)).norm() < 1e-12);
  CHECK((v[2] - Eigen::Vector3d(0.01, 0, 0)).norm() < 1e-12);
}

}  // namespace test_damp_velocity
