// SPDX-License-Identifier: BSL-1.0
// Contact of rigids, of mapped surfaces, of bodies under two solvers, and what sticks.
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "contact_scene.hpp"

namespace test_contact_bodies {

using namespace sinew;

namespace {
constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.05};
}

TEST_CASE("a ball with rotation rolls down a slope at 5/7 of the acceleration of one that slides") {
  const double angle = 0.3, radius = 0.5, c = std::cos(angle), s = std::sin(angle);
  RigidCoord3<double> start;
  start.center = Eigen::Vector3d(-s, 0, c) * (radius + 0.049);
  auto sim = contact_scene(
      near,
      10,
      floor_node(1000, 0.5, angle),
      node<"ball">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 50, .tolerance = 1e-13},
          MechanicalObject<Rigid3d>{.position = {start}},
          UniformMass<Rigid3d>{
              .vertexMass =
                  RigidMass<double, 3>{
                      2, Eigen::Matrix3d(0.4 * 2 * radius * radius * Eigen::Matrix3d::Identity())}},
          SphereCollisionModel<Rigid3d>{.contactStiffness = 50, .contactDamping = 20, .radius = radius}));
  sim.init();
  auto along = [&] {
    return sim.at<"ball">().state().velocity[0].dot(
        (Eigen::Matrix<double, 6, 1>() << -c, 0, -s, 0, 0, 0).finished());
  };
  for (int i = 0; i < 200; ++i) sim.animate(0.005);
  const double v0 = along();
  for (int i = 0; i < 200; ++i) sim.animate(0.005);
  const double a = 10 * s / (1 + 0.4);
  CHECK((along() - v0) / 1.0 == Approx(a).epsilon(0.01));
  // without slipping: v = w r, r to the surface where the contact is
  const auto& v = sim.at<"ball">().state().velocity[0];
  CHECK(along() == Approx(std::abs(v[4]) * (radius)).epsilon(0.01));
}

TEST_CASE("a rigid body with points on it by a mapping stands on them") {
  const double half = 0.5;
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) ? half : -half, (i & 2) ? half : -half, (i & 4) ? half : -half});
  RigidCoord3<double> start;
  start.center = Eigen::Vector3d(0.3, 0.2, half + 0.2);
  start.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 0.5, 0).normalized()));
  auto sim = contact_scene(
      near,
      10,
      floor_node(2000, 0.3),
      node<"box">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 50, .tolerance = 1e-13},
          MechanicalObject<Rigid3d>{.position = {start}},
          UniformMass<Rigid3d>{
              .vertexMass = RigidMass<double, 3>{3, Eigen::Matrix3d(0.5 * Eigen::Matrix3d::Identity())}},
          node<"corners">(MechanicalObject<Vec3d>{.position = corners},
                          RigidMapping<Rigid3d, Vec3d>{},
                          PointCollisionModel<Vec3d>{.contactStiffness = 10, .contactDamping = 20})));
  sim.init();
  for (int i = 0; i < 2000; ++i) sim.animate(0.005);
  auto const& x = sim.at<"box">().state().position[0];
  // four corners carry 30 N: each is 30/4/k deep, k = 2000 * 10 / 0.05
  CHECK(x.center[2] == Approx(half + 0.05 - 30 / 4.0 / (2000 * 10 / 0.05)).margin(1e-8));
  const Eigen::Vector3d up = x.orientation * Eigen::Vector3d::UnitZ();
  CHECK(std::abs(up[2]) == Approx(1).margin(1e-9));
  CHECK(sim.at<"box">().state().velocity[0].norm() < 1e-7);
}

TEST_CASE("a tower of balls stands: each carries what is above it") {
  const int n = 5;
  std::vector<Eigen::Vector3d> p;
  for (int i = 0; i < n; ++i) p.push_back({0, 0, 0.5 + 0.04 + i * 1.04});
  auto sim = contact_scene(
      near,
      10,
      floor_node(100, 0),
      node<"balls">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 60, .tolerance = 1e-14},
          MechanicalObject<Vec3d>{.position = p},
          UniformMass<Vec3d>{.vertexMass = 1},
          SphereCollisionModel<Vec3d>{
              .selfCollision = true, .contactStiffness = 100, .contactDamping = 10, .radius = 0.5}));
  sim.init();
  for (int i = 0; i < 3000; ++i) sim.animate(0.01);
  // k = 1e4 over contact distance and radii: 0.55 on the floor, 1.05 between two
  double height = 0.55 - n * 10 / (1e4 / 0.55), worst = 0;
  auto const& x = sim.at<"balls">().state().position;
  for (int i = 0; i < n; ++i) {
    worst = std::max(worst, std::abs(x[std::size_t(i)][2] - height));
    height += 1.05 - (n - 1 - i) * 10 / (1e4 / 1.05);
  }
  CHECK(worst < 1e-8);
}

TEST_CASE("what sticks is carried along, and is lost when it is pulled beyond the alarm distance") {
  auto sim = contact_scene(
      near,
      0,
      node<"plate">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                    SphereCollisionModel<Vec3d>{
                        .contactStiffness = 100, .contactResponse = "StickContactForceField", .radius = 0.5}),
      node<"ball">(
          EulerImplicitSolver{},
          CGLinearSolver<>{},
          MechanicalObject<Vec3d>{.position = {{0, 0, 1.04}}},
          UniformMass<Vec3d>{.vertexMass = 1},
          SphereCollisionModel<Vec3d>{.contactStiffness = 100, .contactDamping = 20, .radius = 0.5}));
  sim.init();
  auto& plate = sim.at<"plate">().state();
  auto const& ball = sim.at<"ball">().state();
  // up, slowly
  for (int i = 0; i < 500; ++i) {
    plate.position[0][2] += 0.001;
    sim.animate(0.01);
  }
  CHECK(ball.position[0][2] - plate.position[0][2] == Approx(1.04).margin(0.002));
  CHECK(plate.position[0][2] == Approx(0.5));
  // and away, at once
  plate.position[0][2] -= 1;
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  CHECK(sim.root().get<DefaultContactManager>().contacts.empty());
}

TEST_CASE("a contact between bodies under two solvers is the same force on both") {
  auto sim =
      contact_scene(near,
                    0,
                    node<"a">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{1, 0, 0}}},
                              UniformMass<Vec3d>{.vertexMass = 2},
                              SphereCollisionModel<Vec3d>{.contactStiffness = 10, .radius = 0.5}),
                    node<"b">(EulerImplicitSolver{},
                              CGLinearSolver<>{},
                              MechanicalObject<Vec3d>{.position = {{1.2, 0.1, 0}}},
                              UniformMass<Vec3d>{.vertexMass = 1},
                              SphereCollisionModel<Vec3d>{.contactStiffness = 10, .radius = 0.5}));
  sim.init();
  double fastest = 0;
  for (int i = 0; i < 2000; ++i) {
    sim.animate(0.001);
    const Eigen::Vector3d momentum =
        2 * sim.at<"a">().state().velocity[0] + sim.at<"b">().state().velocity[0];
    REQUIRE((momentum - Eigen::Vector3d(2, 0, 0)).norm() < 1e-12);
    fastest = std::max(fastest, sim.at<"b">().state().velocity[0].norm());
  }
  CHECK(fastest > 1);
}

TEST_CASE("models that share a group, and bodies that do not move, do not collide") {
  auto balls = [](std::vector<int> first, std::vector<int> second, bool moving) {
    auto sim = contact_scene(
        near,
        0,
        node<"a">(EulerImplicitSolver{},
                  CGLinearSolver<>{},
                  MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                  UniformMass<Vec3d>{},
                  SphereCollisionModel<Vec3d>{.moving = moving, .group = first, .radius = 0.5}),
        node<"b">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}}},
                  SphereCollisionModel<Vec3d>{.moving = false, .group = second, .radius = 0.5}));
    sim.init();
    sim.animate(0.01);
    return sim.root().template get<DefaultContactManager>().contacts.size();
  };
  CHECK(balls({1}, {2, 3}, true) == 1);
  CHECK(balls({1, 3}, {2, 3}, true) == 0);
  CHECK(balls({}, {}, true) == 1);
  CHECK(balls({}, {}, false) == 0);
}

TEST_CASE("between two solvers springs and contacts act together") {
  auto ball = [](double x) { return MechanicalObject<Vec3d>{.position = {{x, 0, 0}}}; };
  const SphereCollisionModel<Vec3d> sphere{.contactStiffness = 10, .radius = 0.5};
  auto sim =
      contact_scene(near,
                    0,
                    StiffSpringForceField<Vec3d, Between<"a", "b">>{
                        {{.first = 0, .second = 0, .stiffness = 3, .length = 1}}},
                    node<"a">(EulerExplicitSolver{}, ball(0), UniformMass<Vec3d>{.vertexMass = 2}, sphere),
                    node<"b">(EulerExplicitSolver{}, ball(2), UniformMass<Vec3d>{.vertexMass = 1}, sphere));
  sim.init();
  // 1 m apart they do not touch; the spring, 1 m too long, pulls with 3 N
  sim.animate(0.01);
  CHECK(sim.at<"a">().state().velocity[0][0] == Approx(0.01 * 3 / 2.0));
  CHECK(sim.at<"b">().state().velocity[0][0] == Approx(-0.01 * 3));
}

}  // namespace test_contact_bodies
