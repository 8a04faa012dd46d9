// SPDX-License-Identifier: BSL-1.0
// What sticks by multipliers, and which response answers which pair of models.
#include "lagrangian/contact_scenes.hpp"

namespace test_contact_responses {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

// a point of 2 kg that collides; the contact distance is 0.01 m
auto point_at(Vector3d const& place, Vector3d const& velocity, std::string const& response = "") {
  return node<"point">(EulerExplicitSolver{},
                       MechanicalObject<Vec3d>{.position = {place}, .velocity = {velocity}},
                       UniformMass<Vec3d>{.totalMass = 2},
                       PointCollisionModel<Vec3d>{.contactResponse = response});
}
// three balls of 0.1 m on a slope, each 2 kg
template <FixedString Name>
auto ball_at(double angle, double y) {
  const auto start = on_slope(angle, {0, y, 0.11});
  return node<Name>(EulerExplicitSolver{},
                    MechanicalObject<Vec3d>{.position = {start.center}},
                    UniformMass<Vec3d>{.totalMass = 2},
                    SphereCollisionModel<Vec3d>{.radius = 0.1});
}
auto three_balls(std::string const& rules, double angle = 0.3) {
  auto sim = constrained_scene(near_by(),
                               0,
                               fixed_floor(angle),
                               ball_at<"a">(angle, -2),
                               ball_at<"b">(angle, 0),
                               ball_at<"c">(angle, 2));
  sim.root().get<DefaultContactManager>().rules = rules;
  return sim;
}

}  // namespace

TEST_CASE("a point sticks where it touches, and hangs there by its weight") {
  // thrown from below against a ceiling that it reaches within the first step
  const Vector3d start(0, 0, -0.03), velocity(1, 0.5, 4);
  auto sim =
      constrained_scene(near_by(), 0.5, fixed_floor(), point_at(start, velocity, "StickContactConstraint"));
  sim.at<"floor">().get<TriangleCollisionModel<Vec3d>>().bothSide = true;
  sim.init();
  auto const& point = sim.at<"point">().state();
  sim.animate(dt);
  // the velocity of the free step is that at its end; it touches after the part of it that is 0.02 m high
  const Vector3d v = velocity - dt * Vector3d(0, 0, g), touched = start + 0.02 / v[2] * v;
  CHECK((point.position[0] - touched).norm() < 1e-12);
  for (int i = 0; i < 100; ++i) sim.animate(dt);
  CHECK((point.position[0] - touched).norm() < 1e-11);
  CHECK(point.velocity[0].norm() < 1e-10);
  CHECK((force_on(sim.root().get<DefaultContactManager>(), "/root/point") - Vector3d(0, 0, 2 * g)).norm() <
        1e-8);
}

TEST_CASE("what is found nearer than the contact distance sticks there") {
  auto sim = constrained_scene(
      near_by(), 0.5, fixed_floor(), point_at({0.3, 0.2, 0.004}, {0.5, 0, 3}, "StickContactConstraint"));
  sim.init();
  for (int i = 0; i < 50; ++i) sim.animate(dt);
  CHECK((sim.at<"point">().state().position[0] - Vector3d(0.3, 0.2, 0.004)).norm() < 1e-11);
}

TEST_CASE("velocities first: what sticks stays, and a point slides against friction as it should") {
  auto velocityFirst = [](auto sim) {
    sim.root().template get<FreeMotionAnimationLoop>().solveVelocityConstraintFirst = true;
    return sim;
  };
  auto stuck = velocityFirst(constrained_scene(
      near_by(), 0.5, fixed_floor(), point_at({0, 0, 0.01}, {0, 0, 0}, "StickContactConstraint")));
  auto sliding =
      velocityFirst(constrained_scene(near_by(), 0.3, fixed_floor(), point_at({0, 0, 0.01}, {2, 0, 0})));
  stuck.init(), sliding.init();
  for (int i = 0; i < 50; ++i) stuck.animate(dt), sliding.animate(dt);
  CHECK((stuck.at<"point">().state().position[0] - Vector3d(0, 0, 0.01)).norm() < 1e-11);
  CHECK(sliding.at<"point">().state().velocity[0][0] == Approx(2 - 0.3 * g * 50 * dt).epsilon(1e-9));
  CHECK(sliding.at<"point">().state().position[0][2] == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("rules say which response answers the contacts of which models") {
  const double angle = 0.3;
  auto sim =
      three_balls("a * StickContactConstraint  /root/floor b nullptr * * FrictionContactConstraint?mu=0.1");
  sim.init();
  std::array<Vector3d, 3> start{sim.at<"a">().state().position[0],
                                sim.at<"b">().state().position[0],
                                sim.at<"c">().state().position[0]};
  const int steps = 50;
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  const double t = steps * dt;
  CHECK((sim.at<"a">().state().position[0] - start[0]).norm() < 1e-10);
  CHECK((sim.at<"b">().state().velocity[0] - Vector3d(0, 0, -g * t)).norm() < 1e-10);
  CHECK(sim.at<"c">().state().velocity[0].norm() ==
        Approx(g * (std::sin(angle) - 0.1 * std::cos(angle)) * t).epsilon(1e-8));
}

TEST_CASE("the first rule that fits counts, a model that names a response before all") {
  auto sim = constrained_scene(
      near_by(), 0, fixed_floor(), point_at({0, 0, 0.01}, {1, 0, 0}, "FrictionContactConstraint?mu=0.2"));
  sim.root().get<DefaultContactManager>().rules = "point * nullptr  point * StickContactConstraint";
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(dt);
  CHECK(sim.at<"point">().state().velocity[0][0] == Approx(1 - 0.2 * g * 10 * dt).epsilon(1e-9));
}

TEST_CASE("the frictions of models add up where parameters say none, and mu is for models without") {
  auto slowed = [](std::string const& parameters, double ofPoint, double ofFloor) {
    auto sim = constrained_scene(near_by(), 0, fixed_floor(), point_at({0, 0, 0.01}, {4, 0, 0}));
    sim.root().template get<DefaultContactManager>().responseParams = parameters;
    sim.template at<"point">().template get<PointCollisionModel<Vec3d>>().contactFriction = ofPoint;
    sim.template at<"floor">().template get<TriangleCollisionModel<Vec3d>>().contactFriction = ofFloor;
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(dt);
    return (4 - sim.template at<"point">().state().velocity[0][0]) / (g * 10 * dt);
  };
  CHECK(slowed("mu=0.5", 0.1, 0.2) == Approx(0.5).epsilon(1e-9));
  CHECK(slowed("", 0.1, 0.2) == Approx(0.3).epsilon(1e-9));
  CHECK(slowed("", 0, 0) == Approx(0.8).epsilon(1e-9));
}

TEST_CASE("rules that say nothing are refused, with what to do") {
  auto wrong = [](std::string const& rules) {
    auto sim = three_balls(rules);
    try {
      sim.init();
    } catch (Error const& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(wrong("a StickContactConstraint"), Catch::Contains("each rule has three"));
  CHECK_THAT(wrong("a d StickContactConstraint"), Catch::Contains("'d'"));
  CHECK_THAT(wrong("* * Glue"), Catch::Contains("'Glue'") && Catch::Contains("StickContactConstraint"));
  CHECK_THAT(wrong("* * FrictionContactConstraint?mu=-1"), Catch::Contains("coefficient of friction"));
  CHECK_THAT(wrong("* * FrictionContactConstraint?friction=1"), Catch::Contains("it has: mu"));
  CHECK(wrong("default") == "no error");
}

}  // namespace test_contact_responses
