// SPDX-License-Identifier: BSL-1.0
// Contacts that give way; hard ones are those of UnilateralLagrangianConstraint.
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>

namespace test_augmented_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double mass = 2, dt = 0.01, g = 9.81;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
using Contact = AugmentedLagrangianConstraint<Vec3d, Between<"ground", "body">>;

template <class Ode, class... Linear>
auto above(Contact contact, double height, double slope, bool velocityFirst, Ode ode, Linear... linear) {
  return RegistryScene{node<"root">(Gravity{g * Eigen::Vector3d(slope, 0, -1)},
                                    FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                                    gaussSeidel,
                                    contact,
                                    node<"ground">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}),
                                    node<"body">(ode,
                                                 linear...,
                                                 MechanicalObject<Vec3d>{.position = {{0, 0, height}}},
                                                 UniformMass<Vec3d>{.vertexMass = mass}))};
}
Contact soft(double compliance, double damping, double mu = 0) {
  return {.first_point = {0},
          .second_point = {0},
          .normal = {{0, 0, 1}},
          .contactDistance = {0.1},
          .mu = {mu},
          .compliance = compliance,
          .damping = damping};
}

}  // namespace

TEST_CASE("a soft contact is a spring and a damper at the end of the step") {
  auto run = [](double compliance, double damping, double height, bool velocityFirst, auto... solvers) {
    CAPTURE(compliance, damping, velocityFirst);
    auto sim = above(soft(compliance, damping), height, 0, velocityFirst, solvers...);
    sim.init();
    auto const& body = sim.template at<"body">().state();
    auto const& f = sim.root().template get<Contact>().multipliers;
    double z = height, v = 0;
    for (int i = 0; i < 200; ++i) {
      sim.animate(dt);
      // m (v1 - v0)/h = F - m g with F = -(d1/C + c (d1 - min(d0, 0))/h), d = z - 0.1, z1 = z0 + h v1
      const double k = 1 / compliance, d0 = z - 0.1, free = v - g * dt;
      double next = (mass * free - dt * k * d0 - damping * (d0 - std::min(d0, 0.0))) /
                    (mass + dt * dt * k + dt * damping);
      const double d1 = d0 + dt * next, force = -(k * d1 + damping * (d1 - std::min(d0, 0.0)) / dt);
      if (force <= 0) next = free;
      v = next;
      z += dt * v;
      REQUIRE(f.size() == 1);
      CHECK(f[0] == Approx(std::max(force, 0.0)).margin(1e-8));
      CHECK(body.position[0][2] == Approx(z).margin(1e-11));
      CHECK(body.velocity[0][2] == Approx(v).margin(1e-9));
    }
    CHECK(z < 0.2);
  };
  for (const bool velocityFirst : {false, true}) {
    run(1e-3, 0, 0.3, velocityFirst, EulerExplicitSolver{});
    run(1e-3, 50, 0.3, velocityFirst, EulerExplicitSolver{});
    run(1e-6, 10, 0.1, velocityFirst, EulerExplicitSolver{});
    run(1e-3, 50, 0.3, velocityFirst, EulerImplicitSolver{}, SparseLDLSolver<>{});
  }
}

TEST_CASE("a soft contact carries a weight as deep as its compliance says, with friction on all of it") {
  for (const double slope : {0.3, 0.7}) {
    auto sim = above(soft(1e-4, 300, 0.5), 0.1, slope, false, EulerImplicitSolver{}, SparseLDLSolver<>{});
    sim.init();
    for (int i = 0; i < 300; ++i) sim.animate(dt);
    const double before = sim.at<"body">().state().velocity[0][0];
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    auto const& body = sim.at<"body">().state();
    CHECK(body.position[0][2] == Approx(0.1 - mass * g * 1e-4).margin(1e-9));
    CHECK(body.velocity[0][0] - before ==
          Approx(slope > 0.5 ? g * (slope - 0.5) * 100 * dt : 0).margin(1e-8));
  }
}

TEST_CASE("without compliance it is hard, whatever its damping") {
  auto sim = above(soft(0, 70), 0.3, 0, false, EulerExplicitSolver{});
  sim.init();
  for (int i = 0; i < 100; ++i) sim.animate(dt);
  CHECK(std::abs(sim.at<"body">().state().position[0][2] - 0.1) < 1e-12);
  CHECK(sim.root().get<Contact>().multipliers[0] == Approx(mass * g));
}

TEST_CASE("soft contacts that are the same share the force by their compliance") {
  Contact twice = soft(1e-4, 0);
  twice.first_point = twice.second_point = {0, 0};
  auto sim = above(twice, 0.1, 0, false, EulerImplicitSolver{.rayleighMass = 10}, SparseLDLSolver<>{});
  sim.init();
  for (int i = 0; i < 500; ++i) sim.animate(dt);
  auto const& f = sim.root().get<Contact>().multipliers;
  REQUIRE(f.size() == 2);
  CHECK(f[0] == Approx(mass * g / 2));
  CHECK(f[1] == Approx(mass * g / 2));
  CHECK(sim.at<"body">().state().position[0][2] == Approx(0.1 - mass * g * 1e-4 / 2).margin(1e-9));
}

TEST_CASE("softness that cannot be is refused") {
  auto says = [](Contact contact) {
    return error_of([&] { above(contact, 1, 0, false, EulerExplicitSolver{}).init(); });
  };
  CHECK_THAT(says(soft(-1, 0)), Catch::Contains("compliance"));
  CHECK_THAT(says(soft(0, -1)), Catch::Contains("damping"));
  CHECK_THAT(says(soft(std::nan(""), 0)), Catch::Contains("compliance"));
  CHECK(says(soft(0, 0)).empty());
}

}  // namespace test_augmented_lagrangian_constraint
