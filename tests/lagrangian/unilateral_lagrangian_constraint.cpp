// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>
#include <limits>

namespace test_unilateral_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double mass = 2, dt = 0.01, g = 9.81;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
using Contact = UnilateralLagrangianConstraint<Vec3d, Between<"ground", "body">>;

// a point over another that no solver moves, with gravity turned by an angle
template <class Ode, class... Linear>
auto above(Contact contact, double height, double angle, bool velocityFirst, Ode ode, Linear... linear) {
  return RegistryScene{
      node<"root">(Gravity{g * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle))},
                   FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                   gaussSeidel,
                   contact,
                   node<"ground">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}),
                   node<"body">(ode,
                                linear...,
                                MechanicalObject<Vec3d>{.position = {{0, 0, height}}},
                                UniformMass<Vec3d>{.vertexMass = mass},
                                ConstantForceField<Vec3d>{.indices = {0}, .force = {{0, 0, 0}}}))};
}
const Contact touching{
    .first_point = {0}, .second_point = {0}, .normal = {{0, 0, 3}}, .contactDistance = {0.1}};

}  // namespace

TEST_CASE("a body falls, is held at the contact distance, and let go when it is lifted") {
  auto run = [](bool velocityFirst, auto... solvers) {
    auto sim = above(touching, 0.6, 0, velocityFirst, solvers...);
    sim.init();
    auto body = sim.template at<"body">();
    auto const& f = sim.root().template get<Contact>().multipliers;
    for (int i = 1; i <= 100; ++i) {
      sim.animate(dt);
      const double t = i * dt, free = 0.6 - g * t * (t + dt) / 2;
      REQUIRE(f.size() == 1);
      CHECK(body.state().position[0][2] == Approx(std::max(free, 0.1)));
      if (free > 0.1) CHECK(f[0] == 0);
    }
    CHECK(f[0] == Approx(mass * g));
    CHECK(body.state().velocity[0].norm() < 1e-11);

    body.template get<ConstantForceField<Vec3d>>().force = {{0, 0, 3 * mass * g}};
    sim.animate(dt);
    CHECK(f[0] == 0);
    CHECK(body.state().velocity[0][2] == Approx(2 * g * dt));
    sim.animate(dt);
    CHECK(body.state().velocity[0][2] == Approx(4 * g * dt));
  };
  for (const bool velocityFirst : {false, true}) {
    run(velocityFirst, EulerExplicitSolver{});
    run(velocityFirst, EulerImplicitSolver{}, SparseLDLSolver<>{});
    run(velocityFirst, EulerImplicitSolver{}, CGLinearSolver<>{.tolerance = 1e-14});
  }
}

TEST_CASE("a body on a slope sticks up to the angle of friction, and slides by g (sin a - mu cos a)") {
  for (const bool velocityFirst : {false, true})
    for (const double angle : {0.2, 0.46, 0.47, 0.9}) {
      Contact contact = touching;
      contact.mu = {0.5};  // atan 0.5 = 0.4636
      auto sim = above(contact, 0.1, angle, velocityFirst, EulerExplicitSolver{});
      sim.init();
      sim.keepForces(true);
      for (int i = 0; i < 100; ++i) sim.animate(dt);
      const double a = std::max(0.0, g * (std::sin(angle) - 0.5 * std::cos(angle))), t = 100 * dt;
      auto const& body = sim.at<"body">().state();
      CAPTURE(angle, velocityFirst);
      CHECK((body.position[0] - Eigen::Vector3d(a * t * (t + dt) / 2, 0, 0.1)).norm() < 1e-10);
      CHECK((body.velocity[0] - Eigen::Vector3d(a * t, 0, 0)).norm() < 1e-10);
      auto const& f = sim.root().get<Contact>().multipliers;
      REQUIRE(f.size() == 3);
      CHECK(f[0] == Approx(mass * g * std::cos(angle)));
      CHECK(std::hypot(f[1], f[2]) == Approx(mass * (g * std::sin(angle) - a)));
      // and the body knows it as its reaction
      CHECK((body.reaction[0] - mass * Eigen::Vector3d(a - g * std::sin(angle), 0, g * std::cos(angle)))
                .norm() < 1e-9);
    }
}

TEST_CASE("points of different solvers that strike each other go on together, with their momentum") {
  using Pair = UnilateralLagrangianConstraint<Vec3d, Between<"a", "b">>;
  for (const double mu : {0.0, 0.3}) {
    RegistryScene sim{
        node<"root">(FreeMotionAnimationLoop{},
                     gaussSeidel,
                     Pair{.first_point = {0}, .second_point = {0}, .normal = {{1, 0, 0}}, .mu = {mu}},
                     node<"a">(EulerExplicitSolver{},
                               MechanicalObject<Vec3d>{.position = {{-0.1, 0, 0}}, .velocity = {{3, 0, 0}}},
                               UniformMass<Vec3d>{.totalMass = 1}),
                     node<"b">(EulerImplicitSolver{},
                               SparseLDLSolver<>{},
                               MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{0, 6, 0}}},
                               UniformMass<Vec3d>{.totalMass = 2}))};
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(dt);
    auto const &a = sim.at<"a">().state(), &b = sim.at<"b">().state();
    CHECK((a.velocity[0] + 2 * b.velocity[0] - Eigen::Vector3d(3, 12, 0)).norm() < 1e-11);
    CHECK(a.velocity[0][0] == Approx(1));
    CHECK(b.velocity[0][0] == Approx(1));
    CHECK(b.position[0][0] - a.position[0][0] == Approx(0).margin(1e-12));
    // friction has its share of the impulse of 2 N s, as far as the step of the impact counts
    CHECK(a.velocity[0][1] >= (mu == 0 ? 0 : 0.1));
    CHECK(a.velocity[0][1] <= 2 * mu + 1e-12);
  }
}

TEST_CASE("points of one body keep apart, each pair with its own settings") {
  using Inside = UnilateralLagrangianConstraint<Vec3d>;
  RegistryScene sim{node<"root">(
      FreeMotionAnimationLoop{},
      gaussSeidel,
      node<"body">(EulerImplicitSolver{},
                   SparseLDLSolver<>{},
                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}},
                   UniformMass<Vec3d>{.vertexMass = 1},
                   StiffSpringForceField<Vec3d>{.springs = {{0, 1, 100, 10, 0}, {1, 2, 100, 10, 0}}},
                   Inside{.first_point = {0, 1},
                          .second_point = {1, 2},
                          .normal = {{0, 0, 1}},
                          .contactDistance = {0.5, 0.25}}))};
  sim.init();
  for (int i = 0; i < 500; ++i) sim.animate(dt);
  auto const& x = sim.at<"body">().state().position;
  CHECK(x[1][2] - x[0][2] == Approx(0.5));
  CHECK(x[2][2] - x[1][2] == Approx(0.25));
  CHECK(x[0][2] + x[1][2] + x[2][2] == Approx(3));
  auto const& f = sim.at<"body">().get<Inside>().multipliers;
  CHECK(f[0] == Approx(50));  // of the springs
  CHECK(f[1] == Approx(25));
}

TEST_CASE("contacts that cannot be are refused") {
  auto says = [](Contact contact) {
    return error_of([&] { above(contact, 1, 0, false, EulerExplicitSolver{}).init(); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto with = [](auto&& change) {
    Contact contact = touching;
    change(contact);
    return contact;
  };
  CHECK_THAT(says(with([](auto& c) { c.first_point = {1}; })), Catch::Contains("first_point has 1"));
  CHECK_THAT(says(with([](auto& c) { c.second_point = {-1}; })), Catch::Contains("second_point"));
  CHECK_THAT(says(with([](auto& c) {
               c.second_point = {0, 0};
             })),
             Catch::Contains("1 entries and second_point 2"));
  CHECK_THAT(says(with([](auto& c) { c.normal = {}; })), Catch::Contains("normal has 0"));
  CHECK_THAT(says(with([](auto& c) { c.normal = {{0, 0, 0}}; })), Catch::Contains("normal[0] is zero"));
  CHECK_THAT(says(with([&](auto& c) { c.normal = {{0, nan, 0}}; })), Catch::Contains("normal"));
  CHECK_THAT(says(with([&](auto& c) { c.contactDistance = {nan}; })), Catch::Contains("contactDistance"));
  CHECK_THAT(says(with([](auto& c) {
               c.contactDistance = {1, 2, 3};
             })),
             Catch::Contains("contactDistance has 3"));
  CHECK_THAT(says(with([](auto& c) { c.mu = {-0.1}; })), Catch::Contains("mu"));
  CHECK_THAT(says(with([](auto& c) { c.mu = {}; })), Catch::Contains("mu has 0"));
  CHECK(says({}).empty());  // none

  UnilateralLagrangianConstraint<Vec3d> itself{
      .first_point = {0}, .second_point = {0}, .normal = {{0, 0, 1}}};
  const Vec3d::VecCoord rest(1, Eigen::Vector3d(0, 0, 0));
  CHECK_THAT(error_of([&] { itself.init({"root", rest, {}, {}}); }), Catch::Contains("point 0 and itself"));
}

}  // namespace test_unilateral_lagrangian_constraint
