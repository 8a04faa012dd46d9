// SPDX-License-Identifier: BSL-1.0
// Constraints whose Jacobian turns within a step hold at its end.
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>
#include <numbers>

namespace test_turning_constraints {

using namespace sinew;

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Eigen::Vector3d;
using Joint = BilateralLagrangianConstraint<Vec3d, Between<"ceiling", "rod/end">>;
using Stop = UnilateralLagrangianConstraint<Vec3d, Between<"ceiling", "rod/tip">>;

constexpr double g = 9.81, dt = 0.01, length = 1.2, mass = 3, inertia = mass * length * length / 12;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
const ConvexConstraintSolver convex{.tolerance = 1e-13, .momentumTolerance = 1e-12};

RigidMass<double, 3> rod_mass() { return {mass, Vector3d(inertia, inertia, 0.01).asDiagonal()}; }

/// A rod that hangs on its end, turned out of the vertical by an angle about y and with a spin about it, and
/// a stop beside it.
template <class Solver, class... Ode>
auto pendulum(int iterations, double gravity, double angle, double spin, Solver solver, Stop stop,
              Ode... ode) {
  RigidCoord3<double> start;
  Vector6 turn;
  turn << 0, 0, 0, 0, angle, 0;
  Rigid3d::increment(start, turn);
  start.center = start.orientation * Vector3d(0, 0, -length / 2);
  Vector6 v;
  v << Vector3d(0, spin, 0).cross(start.center), 0, spin, 0;
  return RegistryScene{
      node<"root">(Gravity{{0, 0, -gravity}},
                   FreeMotionAnimationLoop{.newtonIterations = iterations},
                   solver,
                   Joint{.first_point = {0}, .second_point = {0}},
                   stop,
                   node<"ceiling">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0.3, 0, 0}}}),
                   node<"rod">(ode...,
                               MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}},
                               UniformMass<Rigid3d>{.vertexMass = rod_mass()},
                               node<"end">(MechanicalObject<Vec3d>{.position = {{0, 0, length / 2}}},
                                           RigidMapping<Rigid3d, Vec3d>{}),
                               node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0, -length / 2}}},
                                           RigidMapping<Rigid3d, Vec3d>{})))};
}
template <class Sim>
double gap_of(Sim& sim) {
  return sim.template at<"rod/end">().state().position[0].norm();
}

}  // namespace

TEST_CASE(
    "a rod that turns by 0.1 to 0.5 rad a step about its end stays on it, with the spin of the first step",
    "[long]") {
  // The centre, l from the end, goes straight on from its start, and is drawn to the circle by a force on the
  // end, of which the part across the lever turns the rod back: the first step turns by phi with
  //   phi = theta - (m l^2 / I) (sin phi - theta),   theta the turn that the velocities at the start make.
  // From then on the force is along the lever, the spin is phi / dt, and the force m l (2 - 2 cos phi) /
  // dt^2.
  const double l = length / 2, ratio = mass * l * l / inertia;
  auto run = [&](double theta, auto solver, auto... ode) {
    double phi = theta;
    for (int i = 0; i < 50; ++i)
      phi -= (phi + ratio * std::sin(phi) - (1 + ratio) * theta) / (1 + ratio * std::cos(phi));
    auto sim = pendulum(30, 0, 0.3, theta / dt, solver, Stop{}, ode...);
    sim.init();
    for (int i = 0; i < 1000; ++i) {
      sim.animate(dt);
      CHECK(gap_of(sim) < 1e-10);
      CHECK(sim.template at<"rod">().state().velocity[0][4] == Approx(phi / dt).epsilon(1e-9));
    }
    const double force = mass * l * 2 * (1 - std::cos(phi)) / (dt * dt);
    auto const& f = sim.root().template get<Joint>().multipliers;
    CHECK(std::hypot(f[0], f[1], f[2]) == Approx(force).epsilon(1e-8));
    CHECK(sim.warnings().list().empty());
  };
  for (const double theta : {0.1, 0.3, 0.5}) {
    run(theta, gaussSeidel, EulerExplicitSolver{});
    run(theta, convex, EulerImplicitSolver{}, SparseLDLSolver<>{});
  }
}

TEST_CASE(
    "by the tangents of the start alone the rod leaves its end by the square of the turn, and says nothing") {
  const double turn = 0.3;
  auto sim = pendulum(0, 0, 0.3, turn / dt, gaussSeidel, Stop{}, EulerExplicitSolver{});
  sim.init();
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    sim.animate(dt);
    largest = std::max(largest, gap_of(sim));
  }
  CHECK(largest > 0.5 * turn * turn * length / 4);
  CHECK(largest < 2 * turn * turn * length / 4);
  CHECK(sim.warnings().list().empty());
}

TEST_CASE("where the iterations do not suffice, a warning says by how much and what to do") {
  auto sim = pendulum(1, 0, 0.3, 0.5 / dt, gaussSeidel, Stop{}, EulerExplicitSolver{});
  sim.init();
  for (int i = 0; i < 5; ++i) sim.animate(dt);
  REQUIRE(sim.warnings().list().size() == 1);
  const std::string message = sim.warnings().list()[0].text();
  CHECK(message.find("constraints that turn within the step are off by") != std::string::npos);
  CHECK(message.find("newtonIterations") != std::string::npos);
}

TEST_CASE("a pendulum that swings through half a turn has the period of the elliptic integral") {
  // a quarter of the period is sqrt(I / (m g l)) K(sin(angle / 2)), and K(sin(pi/4)) = 1.8540746773013719
  const double l = length / 2;
  const double quarter = 1.8540746773013719 * std::sqrt((inertia + mass * l * l) / (mass * g * l));
  auto error = [&](int stepsOfQuarter) {
    const double step = quarter / stepsOfQuarter;
    auto sim = pendulum(30, g, std::numbers::pi / 2, 0, gaussSeidel, Stop{}, EulerExplicitSolver{});
    sim.init();
    double before = 0;
    for (int i = 0;; ++i) {
      before = sim.template at<"rod">().state().position[0].center[0];
      sim.animate(step);
      CHECK(gap_of(sim) < 1e-10);
      const double x = sim.template at<"rod">().state().position[0].center[0];
      if (x * before <= 0 && i > 0) return std::abs(step * (i + before / (before - x)) - quarter) / quarter;
    }
  };
  // of the order of the step, as explicit Euler is from a start at rest
  const double coarse = error(50), fine = error(200);
  CHECK(coarse < 0.02);
  CHECK(fine < coarse / 3);
}

TEST_CASE("a rod on its end that falls against a stop lies there: the joint holds, and the stop too") {
  // the tip of the rod is kept at x <= 0.2 m, beside a point of the ceiling at 0.3 m
  const Stop stop{.first_point = {1}, .second_point = {0}, .normal = {{-1, 0, 0}}, .contactDistance = {0.1}};
  auto run = [&](auto solver, auto... ode) {
    auto sim = pendulum(30, g, -1.2, 0, solver, stop, ode...);
    sim.init();
    double nearest = 1;
    for (int i = 0; i < 300; ++i) {
      sim.animate(dt);
      CHECK(gap_of(sim) < 1e-10);
      nearest = std::min(nearest, 0.2 - sim.template at<"rod/tip">().state().position[0][0]);
    }
    return std::pair(nearest, sim.template at<"rod">().state().velocity[0].norm());
  };
  for (auto [nearest, speed] :
       {run(gaussSeidel, EulerExplicitSolver{}), run(convex, EulerImplicitSolver{}, SparseLDLSolver<>{})}) {
    CHECK(nearest > -1e-10);
    CHECK(speed < 1e-9);  // it lies
  }
}

TEST_CASE("two bodies that levers join, and that turn by 0.2 rad a step, keep momentum, energy and joint") {
  using Hinge = BilateralLagrangianConstraint<Vec3d, Between<"a/end", "b/end">>;
  auto body = [](double x, Vector6 const& v) {
    RigidCoord3<double> start;
    start.center = {x, 0, 0};
    return MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}};
  };
  auto end = [](double x) { return MechanicalObject<Vec3d>{.position = {{x, 0, 0}}}; };
  Vector6 va, vb;  // the joint in the origin has no velocity on either of them
  va << 0, 5, 0, 0, 0, 5;
  vb << 0, -15, 10, 0, -10, -15;
  const Eigen::Matrix3d inertias = Vector3d(0.1, 0.1, 0.1).asDiagonal();
  RegistryScene sim{
      node<"root">(FreeMotionAnimationLoop{.newtonIterations = 60},
                   gaussSeidel,
                   Hinge{.first_point = {0}, .second_point = {0}},
                   node<"a">(EulerExplicitSolver{},
                             body(-1, va),
                             UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, inertias}},
                             node<"end">(end(1), RigidMapping<Rigid3d, Vec3d>{})),
                   node<"b">(EulerExplicitSolver{},
                             body(1, vb),
                             UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, inertias}},
                             node<"end">(end(-1), RigidMapping<Rigid3d, Vec3d>{})))};
  sim.init();
  auto momentum = [&]() -> Vector3d {
    return sim.at<"a">().state().velocity[0].head<3>() + 2 * sim.at<"b">().state().velocity[0].head<3>();
  };
  auto energy = [&] {
    double sum = 0;
    auto add = [&](Vector6 const& v, double m) {
      sum += (m * v.head<3>().squaredNorm() + 0.1 * v.tail<3>().squaredNorm()) / 2;
    };
    add(sim.at<"a">().state().velocity[0], 1);
    add(sim.at<"b">().state().velocity[0], 2);
    return sum;
  };
  const Vector3d before = momentum();
  double largestTurn = 0, worst = 0, first = 0, largestChange = 0;
  for (int i = 0; i < 1000; ++i) {
    sim.animate(dt);
    worst = std::max(worst,
                     (sim.at<"a/end">().state().position[0] - sim.at<"b/end">().state().position[0]).norm());
    if (i == 0) first = energy();
    largestChange = std::max(largestChange, std::abs(energy() / first - 1));
    largestTurn = std::max(largestTurn, dt * sim.at<"b">().state().velocity[0].tail<3>().norm());
  }
  CHECK(worst < 1e-10);
  CHECK((momentum() - before).norm() < 1e-9 * before.norm());
  CHECK(largestChange < 0.01);  // of the energy, which does not drift
  CHECK(largestTurn > 0.15);
  CHECK(sim.warnings().list().empty());
}

}  // namespace test_turning_constraints
