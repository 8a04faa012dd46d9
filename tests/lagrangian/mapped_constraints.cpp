// SPDX-License-Identifier: BSL-1.0
// Constraints on points that mappings move.
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>
#include <numbers>

namespace test_mapped_constraints {

using namespace sinew;

namespace {

constexpr double g = 9.81;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

TEST_CASE("a rod that hangs on a point swings as a physical pendulum, and stays on it") {
  // a rod of length L on its end: period 2 pi sqrt(I / (m g L/2)) of small swings, I = m L^2 / 3
  const double length = 1.2, mass = 3, amplitude = 0.02, dt = 1e-3;
  const double period = 2 * std::numbers::pi * std::sqrt(2 * length / (3 * g));
  auto run = [&](bool velocityFirst, auto... solvers) {
    RigidCoord3<double> start;
    Vector6 turn;
    turn << 0, 0, 0, 0, amplitude, 0;
    Rigid3d::increment(start, turn);
    start.center = start.orientation * Eigen::Vector3d(0, 0, -length / 2);
    using Joint = BilateralLagrangianConstraint<Vec3d, Between<"ceiling", "rod/end">>;
    const double inertia = mass * length * length / 12;
    RegistryScene sim{node<"root">(
        Gravity{{0, 0, -g}},
        FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
        gaussSeidel,
        Joint{.first_point = {0}, .second_point = {0}},
        node<"ceiling">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}),
        node<"rod">(solvers...,
                    MechanicalObject<Rigid3d>{.position = {start}},
                    UniformMass<Rigid3d>{
                        .vertexMass =
                            RigidMass<double, 3>{mass, Eigen::Vector3d(inertia, inertia, 0.01).asDiagonal()}},
                    node<"end">(MechanicalObject<Vec3d>{.position = {{0, 0, length / 2}}},
                                RigidMapping<Rigid3d, Vec3d>{})))};
    sim.init();
    auto const& end = sim.template at<"rod/end">().state();
    auto const& rod = sim.template at<"rod">().state();
    const double speed = amplitude * 2 * std::numbers::pi / period;  // the largest angular velocity
    double before = rod.position[0].center[0], back = 0;
    int crossings = 0;
    for (int i = 0; i < 3000; ++i) {
      sim.animate(dt);
      // the end of a lever L/2 that turns by w dt in a step is beside the tangent
      CHECK(end.position[0].norm() < std::pow(1.05 * speed * dt, 2) * length / 4 + 1e-12);
      const double x = rod.position[0].center[0];
      if (x * before < 0 && ++crossings == 2) back = sim.time() - dt * x / (x - before);
      before = x;
    }
    CHECK(back == Approx(0.75 * period).epsilon(2e-3));  // from the side
    auto const& f = sim.root().template get<Joint>().multipliers;
    CHECK(std::abs(f[2]) == Approx(mass * g).epsilon(1e-2));
  };
  for (const bool velocityFirst : {false, true}) {
    run(velocityFirst, EulerExplicitSolver{});
    run(velocityFirst, EulerImplicitSolver{}, SparseLDLSolver<>{});
  }
}

TEST_CASE(
    "two rigid bodies that points join keep momentum and angular momentum, and come to no more than a step "
    "apart") {
  using Joint = BilateralLagrangianConstraint<Vec3d, Between<"a/end", "b/end">>;
  auto body = [](double x, Vector6 const& v) {
    RigidCoord3<double> start;
    start.center = {x, 0, 0};
    return MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}};
  };
  auto end = [](double x) { return MechanicalObject<Vec3d>{.position = {{x, 0, 0}}}; };
  Vector6 va, vb;  // the joint in the origin has no velocity on either of them
  va << 0, 1, 0, 0, 0, -1;
  vb << 0, -2, 1, 0, -1, -2;
  const Eigen::Vector3d inertia(0.1, 0.1, 0.1);
  RegistryScene sim{node<"root">(
      FreeMotionAnimationLoop{},
      gaussSeidel,
      Joint{.first_point = {0}, .second_point = {0}},
      node<"a">(EulerExplicitSolver{},
                body(-1, va),
                UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, inertia.asDiagonal()}},
                node<"end">(end(1), RigidMapping<Rigid3d, Vec3d>{})),
      node<"b">(EulerImplicitSolver{},
                SparseLDLSolver<>{},
                body(1, vb),
                UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, inertia.asDiagonal()}},
                node<"end">(end(-1), RigidMapping<Rigid3d, Vec3d>{})))};
  auto measured = [&] {
    Vector6 sum = Vector6::Zero();
    auto add = [&](auto const& s, double m) {
      const Eigen::Vector3d v = s.velocity[0].template head<3>(), w = s.velocity[0].template tail<3>();
      sum.head<3>() += m * v;
      sum.tail<3>() += m * s.position[0].center.cross(v) + inertia.cwiseProduct(w);
    };
    add(sim.at<"a">().state(), 1);
    add(sim.at<"b">().state(), 2);
    return sum;
  };
  sim.init();
  sim.keepForces(true);
  const Vector6 before = measured();
  const double dt = 1e-3;
  for (int i = 0; i < 1000; ++i) {
    sim.animate(dt);
    CHECK((sim.at<"a/end">().state().position[0] - sim.at<"b/end">().state().position[0]).norm() <
          2 * 4 * dt * dt);  // levers of 1 m that turn at no more than 4 rad/s, (w dt)^2 / 2
    const auto ra = sim.at<"a">().state().reaction[0], rb = sim.at<"b">().state().reaction[0];
    CHECK((ra + rb).head<3>().norm() < 1e-9 * (1 + ra.norm()));
  }
  CHECK((measured() - before).head<3>().norm() < 1e-11);
  CHECK((measured() - before).tail<3>().norm() < 0.01 * before.tail<3>().norm());  // to the order of the step
}

TEST_CASE("a soft body hangs on a point inside it, which carries its weight") {
  using Joint = BilateralLagrangianConstraint<Vec3d, Between<"nail", "body/inside">>;
  const Eigen::Vector3d inside(0.2, 0.2, 0.3);
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, -g}},
      FreeMotionAnimationLoop{},
      gaussSeidel,
      Joint{.first_point = {0}, .second_point = {0}},
      node<"nail">(MechanicalObject<Vec3d>{.position = {inside}}),
      node<"body">(EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 5},
                   SparseLDLSolver<>{},
                   TetrahedronTopology{{{0, 1, 2, 3}}},
                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                   UniformMass<Vec3d>{.totalMass = 2},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {2e5}, .poissonRatio = 0.3},
                   node<"inside">(MechanicalObject<Vec3d>{.position = {inside}},
                                  BarycentricMapping<Vec3d, Vec3d>{})))};
  sim.init();
  for (int i = 0; i < 2000; ++i) {
    sim.animate(0.05);
    CHECK((sim.at<"body/inside">().state().position[0] - inside).norm() < 1e-10);
  }
  auto const& f = sim.root().get<Joint>().multipliers;
  CHECK((Eigen::Vector3d(f[0], f[1], f[2]) - Eigen::Vector3d(0, 0, 2 * g)).norm() < 1e-6);
  // at rest its centre of mass is below the nail, but for what corotational forces have of a torque, which is
  // their force times the displacement, of the order of m g / (E 1 m)
  Eigen::Vector3d center(0, 0, 0);
  for (auto const& x : sim.at<"body">().state().position) center += x / 4;
  CHECK((center - inside).head<2>().norm() < 2 * g / 2e5);
  CHECK(center[2] < inside[2]);
}

TEST_CASE("a rod that hangs on a point with several parents swings as on the point of the rod itself") {
  // the multipliers turn with the rod: their geometric stiffness goes through both mappings to its turn
  using End = MechanicalObject<Vec3d>;
  using Rod = RigidMapping<Rigid3d, Vec3d>;
  auto body = [](auto joint, auto... others) {
    RigidCoord3<double> start;
    start.center = {0.6, 0, 0};
    const double inertia = 3 * 1.2 * 1.2 / 12;
    return RegistryScene{node<"root">(
        Gravity{{0, 0, -g}},
        FreeMotionAnimationLoop{},
        gaussSeidel,
        joint,
        node<"ceiling">(End{.position = {{0, 0, 0}}}),
        node<"rod">(
            EulerImplicitSolver{},
            SparseLDLSolver<>{},
            MechanicalObject<Rigid3d>{.position = {start}},
            UniformMass<Rigid3d>{
                .vertexMass = RigidMass<double, 3>{3, Eigen::Vector3d(0.01, inertia, inertia).asDiagonal()}},
            node<"end">(End{.position = {{-0.6, 0, 0}}}, Rod{}),
            node<"tip">(End{.position = {{0.6, 0, 0}}}, Rod{}),
            others...))};
  };
  auto direct = body(BilateralLagrangianConstraint<Vec3d, Between<"ceiling", "rod/end">>{
      .first_point = {0}, .second_point = {0}});
  auto joined = body(
      BilateralLagrangianConstraint<Vec3d, Between<"ceiling", "rod/joined">>{.first_point = {0},
                                                                             .second_point = {0}},
      node<"joined">(End{.position = {{0, 0, 0}}},
                     SubsetMultiMapping<Vec3d, Vec3d, Parents<"../end", "../tip">>{.indexPairs = {{0, 0}}}));
  direct.init();
  joined.init();
  double lowest = 0;
  for (int i = 0; i < 200; ++i) {
    direct.animate(0.01);
    joined.animate(0.01);
    auto const& a = direct.at<"rod">().state();
    auto const& b = joined.at<"rod">().state();
    CHECK((a.position[0].center - b.position[0].center).norm() < 1e-9);
    CHECK((a.velocity[0] - b.velocity[0]).norm() < 1e-7);
    lowest = std::min(lowest, a.position[0].center[2]);
  }
  CHECK(lowest < -0.5);
}

}  // namespace test_mapped_constraints
