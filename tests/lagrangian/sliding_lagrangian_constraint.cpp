// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <array>
#include <cmath>

namespace test_sliding_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double mass = 2, dt = 0.01, angle = 0.4;
const Eigen::Vector3d gravity(0, 0, -9.81), down(std::cos(angle), 0, -std::sin(angle));
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
using Sliding = SlidingLagrangianConstraint<Vec3d, Between<"bead", "rail">>;

// a bead on a rail of 2 m that no solver moves
template <class Ode, class... Linear>
auto incline(Sliding sliding, bool velocityFirst, Ode ode, Linear... linear) {
  return RegistryScene{
      node<"root">(Gravity{gravity},
                   FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                   gaussSeidel,
                   sliding,
                   node<"bead">(ode,
                                linear...,
                                MechanicalObject<Vec3d>{.position = {{9, 9, 9}, {0, 0, 0}}},
                                UniformMass<Vec3d>{.vertexMass = mass}),
                   node<"rail">(MechanicalObject<Vec3d>{.position = {{9, 9, 9}, -0.5 * down, 1.5 * down}}))};
}

}  // namespace

TEST_CASE("a bead slides down a rail by g sin a, and stops at its end") {
  auto run = [](int first, int second, bool velocityFirst, auto... solvers) {
    auto sim = incline({.sliding_point = 1, .axis_1 = first, .axis_2 = second}, velocityFirst, solvers...);
    sim.init();
    auto const& bead = sim.template at<"bead">().state();
    auto const& f = sim.root().template get<Sliding>().multipliers;
    const double g = gravity.norm();
    for (int i = 1; i <= 200; ++i) {
      sim.animate(dt);
      const double t = i * dt, s = g * std::sin(angle) * t * (t + dt) / 2, along = bead.position[1].dot(down);
      REQUIRE(f.size() == 4);
      CHECK((bead.position[1] - along * down).norm() < 1e-12);
      CHECK(std::hypot(f[0], f[1]) == Approx(mass * g * std::cos(angle)));
      CHECK(along == Approx(std::min(s, 1.5)));
      if (s < 1.5) {
        CHECK(bead.velocity[1].dot(down) == Approx(g * std::sin(angle) * t));
        CHECK(f[2] + f[3] == 0);
      }
    }
    CHECK(bead.velocity[1].norm() < 1e-11);
    // the end of the rail pushes
    CHECK(f[second == 2 ? 3 : 2] == Approx(mass * g * std::sin(angle)));
    CHECK(f[second == 2 ? 2 : 3] == 0);
  };
  for (const bool velocityFirst : {false, true}) {
    run(1, 2, velocityFirst, EulerExplicitSolver{});
    run(2, 1, velocityFirst, EulerExplicitSolver{});
    run(1, 2, velocityFirst, EulerImplicitSolver{}, SparseLDLSolver<>{});
  }
}

TEST_CASE("a bead at a rail without length is held there") {
  auto sim = incline({.sliding_point = 1, .axis_1 = 2, .axis_2 = 2}, false, EulerExplicitSolver{});
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(dt);
  CHECK((sim.at<"bead">().state().position[1] - 1.5 * down).norm() < 1e-12);
  auto const& f = sim.root().get<Sliding>().multipliers;
  REQUIRE(f.size() == 3);
  CHECK((Eigen::Vector3d(f[0], f[1], f[2]) + mass * gravity).norm() < 1e-9);
}

TEST_CASE("a bead and the free rail on which it slides keep their momentum, and the bead its line") {
  using Joint = SlidingLagrangianConstraint<Vec3d>;
  RegistryScene sim{
      node<"root">(FreeMotionAnimationLoop{},
                   gaussSeidel,
                   node<"all">(EulerImplicitSolver{},
                               SparseLDLSolver<>{},
                               MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {2, 0, 0}, {0.5, 0, 0}},
                                                       .velocity = {{0, 0, 0}, {0, 0.1, 0}, {0.3, -1, 0.5}}},
                               DiagonalMass<Vec3d>{.vertexMass = {1, 2, 4}},
                               StiffSpringForceField<Vec3d>{.springs = {{0, 1, 1000, 0, 2}}},
                               Joint{.sliding_point = 2, .axis_1 = 0, .axis_2 = 1}))};
  sim.init();
  sim.keepForces(true);
  auto const& s = sim.at<"all">().state();
  const double masses[] = {1, 2, 4};
  auto momentum = [&] {
    Eigen::Vector3d p(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) p += masses[i] * s.velocity[i];
    return p;
  };
  const Eigen::Vector3d before = momentum();
  for (int i = 0; i < 300; ++i) {
    sim.animate(0.005);
    CHECK((momentum() - before).norm() < 1e-11);
    const Eigen::Vector3d axis = s.position[1] - s.position[0],
                          off = (s.position[2] - s.position[0]).cross(axis) / axis.norm();
    // what the axis turns in a step times what the bead goes along it
    CHECK(off.norm() < 5 * 0.005 * 0.005);
    // the reaction of the bead is on the rail
    Eigen::Vector3d sum(0, 0, 0);
    for (auto const& r : s.reaction) sum += r;
    CHECK(sum.norm() < 1e-9 * (1 + s.reaction[2].norm()));
  }
  CHECK((s.position[2] - s.position[0]).dot(s.position[1] - s.position[0]) >= 0);
}

TEST_CASE("a rigid body slides with its centre, and turns as it likes") {
  using Joint = SlidingLagrangianConstraint<Rigid3d, Between<"bead", "rail">>;
  RigidCoord3<double> start, end;
  end.center = 10 * down;
  Eigen::Matrix<double, 6, 1> v;
  v << 0, 0, 0, 0, 3, 0;
  RegistryScene sim{node<"root">(Gravity{gravity},
                                 FreeMotionAnimationLoop{},
                                 gaussSeidel,
                                 Joint{.axis_2 = 1},
                                 node<"bead">(EulerExplicitSolver{},
                                              MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}},
                                              UniformMass<Rigid3d>{.totalMass = mass}),
                                 node<"rail">(MechanicalObject<Rigid3d>{.position = {start, end}}))};
  sim.init();
  for (int i = 0; i < 50; ++i) sim.animate(dt);
  auto const& bead = sim.at<"bead">().state();
  const double t = 50 * dt;
  CHECK((bead.position[0].center - gravity.norm() * std::sin(angle) * t * (t + dt) / 2 * down).norm() <
        1e-10);
  CHECK((bead.velocity[0].tail<3>() - Eigen::Vector3d(0, 3, 0)).norm() < 1e-10);
}

TEST_CASE("points that are not there are refused") {
  auto says = [](Sliding sliding) {
    return error_of([&] { incline(sliding, false, EulerExplicitSolver{}).init(); });
  };
  CHECK_THAT(says({.sliding_point = 2}),
             Catch::Contains("sliding_point has 2") && Catch::Contains("SlidingLagrangian"));
  CHECK_THAT(says({.axis_1 = 3}), Catch::Contains("axis_1 or axis_2 has 3"));
  CHECK_THAT(says({.axis_2 = -1}), Catch::Contains("axis_2"));
}

TEST_CASE("the points of a rail follow when elements are removed, and without one it holds nothing") {
  using Own = SlidingLagrangianConstraint<Vec3d>;
  RegistryScene sim{node<"root">(
      Gravity{gravity},
      FreeMotionAnimationLoop{},
      gaussSeidel,
      node<"body">(EulerExplicitSolver{},
                   TetrahedronTopology{{{1, 2, 3, 0}, {1, 3, 2, 4}, {5, 2, 3, 4}}},
                   MechanicalObject<Vec3d>{
                       .position = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, -1}, {2, 1, -1}}},
                   UniformMass<Vec3d>{.vertexMass = mass},
                   Own{.sliding_point = 1, .axis_1 = 2, .axis_2 = 3}))};
  sim.init();
  sim.removeElements("body", {.tetrahedra = {0}});
  auto own = [&]() -> Own& { return sim.at<"body">().get<Own>(); };
  CHECK(std::array{own().sliding_point, own().axis_1, own().axis_2} == std::array{0, 1, 2});
  sim.animate(dt);
  CHECK(own().multipliers.size() == 4);
  sim.removeElements("body", {.tetrahedra = {0}});  // with it goes point 0
  CHECK(own().none);
  auto const& v = sim.at<"body">().state().velocity;
  const Vec3d::VecDeriv before = v;
  sim.animate(dt);
  CHECK(own().multipliers.empty());
  REQUIRE(v.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK((v[i] - before[i] - dt * gravity).norm() < 1e-12);
}

}  // namespace test_sliding_lagrangian_constraint
