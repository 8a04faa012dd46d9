// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <limits>

namespace test_stopper_lagrangian_constraint {

using namespace sinew;

namespace {

using One = Eigen::Matrix<double, 1, 1>;
constexpr double mass = 2, dt = 0.01;

template <class Ode, class... Linear>
auto rail(StopperLagrangianConstraint<Vec1d> stopper, double speed, double force, bool velocityFirst, Ode ode,
          Linear... linear) {
  return RegistryScene{node<"root">(
      FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
      BlockGaussSeidelConstraintSolver{.tolerance = 1e-14},
      node<"cart">(ode,
                   linear...,
                   MechanicalObject<Vec1d>{.position = {One(7), One(0)}, .velocity = {One(1), One(speed)}},
                   UniformMass<Vec1d>{.vertexMass = mass},
                   ConstantForceField<Vec1d>{.indices = {1}, .force = {One(force)}},
                   stopper))};
}

}  // namespace

TEST_CASE("a cart runs to its stop, and stays there as long as it is pushed") {
  auto run = [](double direction, bool velocityFirst, auto... solvers) {
    auto sim =
        rail({.index = 1, .min = -0.5, .max = 0.25}, 3 * direction, 4 * direction, velocityFirst, solvers...);
    sim.init();
    auto cart = sim.template at<"cart">();
    auto const& f = cart.template get<StopperLagrangianConstraint<Vec1d>>().multipliers;
    const double stop = direction > 0 ? 0.25 : -0.5;
    double impulse = 0;
    for (int i = 1; i <= 100; ++i) {
      sim.animate(dt);
      const double x = cart.state().position[1][0], v = cart.state().velocity[1][0], t = i * dt;
      const double free = direction * (3 * t + 2 * t * (t + dt) / 2);  // a = F/m = 2
      REQUIRE(f.size() == 1);
      CHECK(x <= 0.25 + 1e-12);
      CHECK(x >= -0.5 - 1e-12);
      impulse += f[0] * dt;
      if (std::abs(free) < std::abs(stop)) {
        CHECK(x == Approx(free));
        CHECK(f[0] == 0);
      } else {
        CHECK(x == Approx(stop).margin(1e-12));
      }
      CHECK(mass * v == Approx(direction * (3 * mass + 4 * t) + impulse).margin(1e-10));
    }
    CHECK(std::abs(cart.state().velocity[1][0]) < 1e-10);
    CHECK(f[0] == Approx(-4 * direction));
    CHECK(cart.state().position[0][0] == Approx(8));  // nothing stops the other one

    cart.template get<ConstantForceField<Vec1d>>().force = {One(-direction)};
    sim.animate(dt);
    CHECK(f[0] == 0);
    CHECK(cart.state().velocity[1][0] == Approx(-direction / mass * dt));
  };
  for (const double direction : {1, -1})
    for (const bool velocityFirst : {false, true}) {
      run(direction, velocityFirst, EulerExplicitSolver{});
      run(direction, velocityFirst, EulerImplicitSolver{}, SparseLDLSolver<>{});
    }
}

TEST_CASE("two stops at one place hold") {
  auto sim = rail({.index = 1, .min = 0, .max = 0}, 3, 4, false, EulerExplicitSolver{});
  sim.init();
  for (int i = 0; i < 1000; ++i) sim.animate(dt);
  CHECK(std::abs(sim.at<"cart">().state().position[1][0]) < 1e-13);
}

TEST_CASE("stops that cannot be are refused") {
  auto says = [](StopperLagrangianConstraint<Vec1d> stopper) {
    return error_of([&] { rail(stopper, 0, 0, false, EulerExplicitSolver{}).init(); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(says({.index = 2}),
             Catch::Contains("StopperLagrangianConstraint") && Catch::Contains("2 points"));
  CHECK_THAT(says({.index = -1}), Catch::Contains("index"));
  CHECK_THAT(says({.min = 2, .max = 1}), Catch::Contains("min is 2 and max 1"));
  CHECK_THAT(says({.min = nan}), Catch::Contains("min"));
  CHECK_THAT(says({.max = nan}), Catch::Contains("max"));
  CHECK(says({}).empty());
}

}  // namespace test_stopper_lagrangian_constraint
