// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>
#include <limits>

namespace test_bilateral_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double dt = 0.01, g = 9.81;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-14};
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Body = RigidCoord3<double>;

Body placed(Eigen::Vector3d const& center, Eigen::Vector3d const& turned) {
  Body x;
  Vector6 by;
  by << center, turned;
  Rigid3d::increment(x, by);
  return x;
}
RigidMass<double, 3> mass(double m, Eigen::Vector3d const& inertia) { return {m, inertia.asDiagonal()}; }

template <class D, class E = Between<"a", "b">>
using Joint = BilateralLagrangianConstraint<D, E>;

template <class C>
auto two_bodies(C joint, Body const& a, Body const& b, Vector6 const& va, Vector6 const& vb,
                bool velocityFirst) {
  return RegistryScene{node<"root">(FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                                    gaussSeidel,
                                    joint,
                                    node<"a">(EulerExplicitSolver{},
                                              MechanicalObject<Rigid3d>{.position = {a}, .velocity = {va}},
                                              UniformMass<Rigid3d>{.vertexMass = mass(1, {1, 2, 2.5})}),
                                    node<"b">(EulerImplicitSolver{},
                                              SparseLDLSolver<>{},
                                              MechanicalObject<Rigid3d>{.position = {b}, .velocity = {vb}},
                                              UniformMass<Rigid3d>{.vertexMass = mass(3, {0.5, 0.3, 0.4})}))};
}

}  // namespace

TEST_CASE("rigid bodies that are joined come together within a few steps, in orientation too") {
  Vector6 va, vb;
  va << 1, 0, 0, 0.5, -0.3, 0.2;
  vb << 0, -1, 0, 0, 0.4, -0.6;
  for (const bool velocityFirst : {false, true}) {
    auto sim = two_bodies(Joint<Rigid3d>{.first_point = {0}, .second_point = {0}},
                          placed({0, 0, 0}, {0.1, 0, 0}),
                          placed({0.1, -0.2, 0.1}, {-0.1, 0.2, 0.15}),
                          va,
                          vb,
                          velocityFirst);
    sim.init();
    auto const &a = sim.at<"a">().state(), &b = sim.at<"b">().state();
    for (int i = 0; i < 1000; ++i) {
      sim.animate(dt);
      const Vector6 d = Rigid3d::difference(a.position[0], b.position[0]);
      // each step leaves of a rotation between them about its square
      if (i >= 6) CHECK(d.norm() < 1e-10);
      // what holds the centres keeps momentum
      CHECK((a.velocity[0].head<3>() + 3 * b.velocity[0].head<3>() - Eigen::Vector3d(1, -3, 0)).norm() <
            1e-9);
      // where positions come first, they turn by the free motion and then by the correction, dt^2 (dw/dt):
      // these do not commute, which velocities do not know
      if (i >= 6) CHECK((a.velocity[0] - b.velocity[0]).norm() < (velocityFirst ? 1e-9 : dt * dt / 2));
    }
  }
}

TEST_CASE("joined bodies turn as one body with the sum of their inertias") {
  Vector6 v;
  v << 0, 0, 0, 0.8, 1.5, -0.4;
  auto sim = two_bodies(Joint<Rigid3d>{.first_point = {0}, .second_point = {0}}, Body{}, Body{}, v, v, false);
  RegistryScene one{node<"body">(EulerExplicitSolver{},
                                 MechanicalObject<Rigid3d>{.position = {Body{}}, .velocity = {v}},
                                 UniformMass<Rigid3d>{.vertexMass = mass(4, {1.5, 2.3, 2.9})})};
  auto differs = [&](double step) {
    auto joined = sim;
    auto single = one;
    joined.init();
    single.init();
    for (double t = 0; t < 2 - step / 2; t += step) {
      joined.animate(step);
      single.animate(step);
    }
    return Rigid3d::difference(joined.template at<"a">().state().position[0],
                               single.root().state().position[0])
        .norm();
  };
  // both have errors of the order of the step
  const double coarse = differs(0.01), fine = differs(0.0025);
  CHECK(fine < 0.05);
  CHECK(fine < coarse / 3);
}

TEST_CASE("bodies keep the shift and the rotation of the start, and as they turn") {
  Vector6 v;
  v << 0, 0, 0, 0.4, -0.5, 1;
  const Body a = placed({0, 0, 0}, {0.7, -0.2, 0.4}), b = placed({1, 2, 3}, {-1, 0.5, 0.3});
  auto sim =
      two_bodies(Joint<Rigid3d>{.first_point = {0}, .second_point = {0}, .keepOrientationDifference = true},
                 a,
                 b,
                 v,
                 v,
                 false);
  auto in_first = [&] {
    return (sim.at<"a">().state().position[0].orientation.conjugate() *
            sim.at<"b">().state().position[0].orientation)
        .coeffs()
        .eval();
  };
  sim.init();
  const auto before = in_first();
  double turned = 0;
  for (int i = 0; i < 500; ++i) {
    sim.animate(dt);
    CHECK((sim.at<"b">().state().position[0].center - sim.at<"a">().state().position[0].center -
           Eigen::Vector3d(1, 2, 3))
              .norm() < 1e-10);
    CHECK((in_first() - before).norm() < 1e-10);
    turned = std::max(turned, sim.at<"a">().state().position[0].orientation.angularDistance(a.orientation));
  }
  CHECK(turned > 1);
  // again from the start
  const Body end = sim.at<"b">().state().position[0];
  sim.reset();
  for (int i = 0; i < 500; ++i) sim.animate(dt);
  CHECK(sim.at<"b">().state().position[0] == end);
}

TEST_CASE("a chain of bodies of different solvers hangs, and each joint carries what is below it") {
  auto joint = [](auto ends) {
    return BilateralLagrangianConstraint<Vec3d, decltype(ends)>{
        .first_point = {0}, .second_point = {0}, .rest_vector = {{0, 0, -0.5}}};
  };
  auto point = [](double z) { return MechanicalObject<Vec3d>{.position = {{0, 0, z}}}; };
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, -g}},
      FreeMotionAnimationLoop{},
      gaussSeidel,
      joint(Between<"ceiling", "a">{}),
      joint(Between<"a", "b">{}),
      joint(Between<"b", "c">{}),
      joint(Between<"c", "d">{}),
      node<"ceiling">(point(0)),
      node<"a">(EulerExplicitSolver{}, point(-0.5), UniformMass<Vec3d>{.totalMass = 1}),
      node<"b">(EulerImplicitSolver{}, SparseLDLSolver<>{}, point(-1), UniformMass<Vec3d>{.totalMass = 2}),
      node<"c">(VariationalSymplecticSolver{},
                SparseLDLSolver<>{},
                point(-1.5),
                UniformMass<Vec3d>{.totalMass = 3}),
      node<"d">(EulerExplicitSolver{}, point(-2), UniformMass<Vec3d>{.totalMass = 4}))};
  sim.init();
  sim.keepForces(true);
  for (int i = 0; i < 1000; ++i) sim.animate(dt);
  auto carries = [&](auto ends) {
    auto const& f = sim.root().get<BilateralLagrangianConstraint<Vec3d, decltype(ends)>>().multipliers;
    REQUIRE(f.size() == 3);
    CHECK(std::hypot(f[0], f[1]) < 1e-9);
    return f[2];
  };
  const double top = carries(Between<"ceiling", "a">{}), second = carries(Between<"a", "b">{}),
               third = carries(Between<"b", "c">{}), last = carries(Between<"c", "d">{});
  CHECK(top == Approx(10 * g));
  CHECK(second == Approx(9 * g));
  CHECK(third == Approx(7 * g));
  CHECK(last == Approx(4 * g));
  // what each body feels is the difference of the joints at it
  auto feels = [](auto const& body, double z) {
    CHECK(body.state().position[0].template head<2>().norm() < 1e-12);
    CHECK((body.state().reaction[0] - Eigen::Vector3d(0, 0, z)).norm() < 1e-7);
  };
  feels(sim.at<"a">(), top - second);
  feels(sim.at<"b">(), second - third);
  feels(sim.at<"c">(), third - last);
  feels(sim.at<"d">(), last);
  CHECK(sim.at<"d">().state().position[0][2] == Approx(-2).epsilon(1e-12));
}

TEST_CASE(
    "points of one body are joined, or not where it is not active; a load takes a part of the violation") {
  using Inside = Joint<Vec3d, Within>;
  auto run = [](Inside joint) {
    RegistryScene sim{
        node<"root">(FreeMotionAnimationLoop{},
                     gaussSeidel,
                     node<"body">(EulerExplicitSolver{},
                                  MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}},
                                  UniformMass<Vec3d>{.vertexMass = 2},
                                  ConstantForceField<Vec3d>{.indices = {1}, .force = {{8, 0, 0}}},
                                  joint))};
    sim.init();
    sim.animate(dt);
    return sim.at<"body">().state().velocity;
  };
  Inside joint{.first_point = {0, 1}, .second_point = {1}};  // the second of the first list is free
  auto v = run(joint);
  CHECK(v[0][0] == Approx(8.0 / 4 * dt));
  CHECK(v[1][0] == Approx(8.0 / 4 * dt));
  joint.load = 0.25;  // a quarter of the force of 4 N that would hold them together
  v = run(joint);
  CHECK(v[0][0] == Approx(1.0 / 2 * dt));
  CHECK(v[1][0] == Approx(7.0 / 2 * dt));
  for (const bool by : {false, true}) {
    joint.load = by ? 0 : 1;
    joint.activate = by;
    v = run(joint);
    CHECK(v[0][0] == 0);
    CHECK(v[1][0] == Approx(8.0 / 2 * dt));
  }
}

namespace {

template <class... C>
auto points(BlockGaussSeidelConstraintSolver solver, Vec3d::VecCoord x, C... more) {
  return RegistryScene{node<"root">(FreeMotionAnimationLoop{},
                                    solver,
                                    node<"body">(EulerExplicitSolver{},
                                                 MechanicalObject<Vec3d>{.position = x},
                                                 UniformMass<Vec3d>{.vertexMass = 1},
                                                 more...))};
}
Joint<Vec3d, Within> tie(std::vector<Eigen::Vector3d> rest = {}) {
  return {.first_point = {0}, .second_point = {1}, .rest_vector = rest};
}

}  // namespace

TEST_CASE(
    "joints that say the same are solved, and those that contradict each other stay finite or are told") {
  // one list with the pair twice, from the second body's side the other time
  Joint<Vec3d, Within> twice{.first_point = {0, 1, 0}, .second_point = {1, 0, 1}};
  auto same = points(gaussSeidel, {{0, 0, 0}, {1, 0, 0}}, twice);
  same.init();
  for (int i = 0; i < 10; ++i) same.animate(dt);
  auto const& x = same.at<"body">().state().position;
  CHECK((x[0] - x[1]).norm() < 1e-12);
  CHECK(((x[0] + x[1]) / 2 - Eigen::Vector3d(0.5, 0, 0)).norm() < 1e-12);

  Joint<Vec3d, Within> apart{
      .first_point = {0, 0}, .second_point = {1, 1}, .rest_vector = {{1, 0, 0}, {2, 0, 0}}};
  auto goes = points({.maxIterations = 50}, {{0, 0, 0}, {1, 0, 0}}, apart);
  goes.init();
  for (int i = 0; i < 100; ++i) goes.animate(dt);
  auto const& y = goes.at<"body">().state().position;
  CHECK(y[0].allFinite());
  CHECK(y[1][0] - y[0][0] >= 1 - 1e-9);
  CHECK(y[1][0] - y[0][0] <= 2 + 1e-9);

  auto stops = points({.stopsUnsolved = true}, {{0, 0, 0}, {1, 0, 0}}, apart);
  stops.init();
  CHECK_THAT(error_of([&] { stops.animate(dt); }), Catch::Contains("contradict each other"));
}

TEST_CASE("joints that cannot be are refused") {
  auto says = [](auto... more) {
    return error_of([&] {
      auto sim = points(gaussSeidel, {{0, 0, 0}, {1, 0, 0}}, more...);
      sim.init();
      sim.animate(dt);
    });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto joint = tie();
  joint.first_point = {2};
  CHECK_THAT(says(joint), Catch::Contains("first_point has 2"));
  joint = tie();
  joint.second_point = {-1};
  CHECK_THAT(says(joint), Catch::Contains("second_point"));
  CHECK_THAT(says(tie({{0, nan, 0}})), Catch::Contains("rest_vector"));
  joint = tie();
  joint.load = 1.5;
  CHECK_THAT(says(joint), Catch::Contains("load"));
  // nothing can move
  CHECK_THAT(says(FixedConstraint<Vec3d>{.indices = {0, 1}}, tie()),
             Catch::Contains("BilateralLagrangianConstraint") && Catch::Contains("equation 0"));
  joint = tie();
  joint.second_point = {0};  // a point and itself
  CHECK_THAT(says(joint), Catch::Contains("BilateralLagrangianConstraint"));
  CHECK(says(tie()).empty());
  CHECK(says(Joint<Vec3d, Within>{}).empty());
}

TEST_CASE("what a movement leads, and no solver moves, leads what is joined to it") {
  for (const bool velocityFirst : {false, true}) {
    RegistryScene sim{node<"root">(
        FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
        gaussSeidel,
        BilateralLagrangianConstraint<Vec3d, Between<"led", "leader/tip">>{.first_point = {0},
                                                                           .second_point = {0}},
        node<"led">(EulerImplicitSolver{},
                    SparseLDLSolver<>{},
                    MechanicalObject<Vec3d>{.position = {{0, 0.5, 0}}},
                    UniformMass<Vec3d>{.vertexMass = 2}),
        node<"leader">(
            MechanicalObject<Rigid3d>{.position = {placed({0, 0, 0}, {0, 0, 0})}},
            LinearMovementConstraint<Rigid3d>{
                .indices = {0}, .keyTimes = {0, 1}, .movements = {Vector6::Zero(), Vector6::Unit(1)}},
            node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0.5, 0}}},
                        RigidMapping<Rigid3d, Vec3d>{})))};
    sim.init();
    for (int i = 0; i < 50; ++i) {
      sim.animate(dt);
      // it is where the movement puts it at the end of the step
      CHECK(sim.at<"leader">().state().position[0].center.y() == Approx((i + 1) * dt));
      // by velocities what follows is a step behind the place where the other has come
      CHECK((sim.at<"led">().state().position[0] - sim.at<"leader/tip">().state().position[0]).norm() <
            (velocityFirst ? dt * (1 + 1e-9) : 1e-10));
    }
    CHECK(sim.at<"led">().state().velocity[0].y() == Approx(1));
  }
}

}  // namespace test_bilateral_lagrangian_constraint
