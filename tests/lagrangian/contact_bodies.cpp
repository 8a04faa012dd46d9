// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers between bodies: momenta, energy, stacks, soft bodies, and what cannot move.
#include "lagrangian/contact_scenes.hpp"

namespace test_contact_bodies {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

RigidMass<double, 3> ball(double mass, double radius) {
  return {mass, 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity()};
}
template <FixedString Name, class Ode = EulerExplicitSolver>
auto balls_node(std::vector<Rigid3d::Coord> const& places, std::vector<Rigid3d::Deriv> const& velocities,
                Ode ode = {}) {
  return node<Name>(ode,
                    MechanicalObject<Rigid3d>{.position = places, .velocity = velocities},
                    UniformMass<Rigid3d>{.vertexMass = ball(2, 0.5)},
                    SphereCollisionModel<Rigid3d>{.selfCollision = true, .radius = 0.5});
}
Rigid3d::Deriv moving(Vector3d const& v, Vector3d const& w = Vector3d::Zero()) {
  Rigid3d::Deriv all;
  all << v, w;
  return all;
}
struct Motion {
  Vector3d momentum{0, 0, 0}, angular{0, 0, 0};
  double energy = 0;

  // of balls of 2 kg and 0.5 m; the energy with that of their weight
  template <class State>
  void add(State const& s, double gravity = 0) {
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      const Vector3d v = s.velocity[i].template head<3>(), w = s.velocity[i].template tail<3>();
      momentum += 2 * v;
      angular += 2 * s.position[i].center.cross(v) + 0.2 * w;
      energy += v.squaredNorm() + 0.1 * w.squaredNorm() + 2 * gravity * s.position[i].center[2];
    }
  }
};

}  // namespace

TEST_CASE("an impact keeps the momenta, also between bodies of two solvers and within one body") {
  const MinProximityIntersection skin{.alarmDistance = 0.2, .contactDistance = 0};
  auto impact = [&](auto& sim, double mu, auto&& states) {
    sim.root().template get<Gravity>().gravity.setZero();
    sim.root().template get<DefaultContactManager>().responseParams = text("mu=", mu);
    sim.init();
    auto all = [&] {
      Motion m;
      states(sim, m);
      return m;
    };
    const Motion before = all();
    for (int i = 0; i < 40; ++i) {
      const Motion last = all();
      sim.animate(dt);
      const Motion now = all();
      CHECK((now.momentum - before.momentum).norm() < 1e-12);
      // of frictional forces the two places may still be as far apart as the balls go in a step
      CHECK((now.angular - before.angular).norm() < (mu == 0 ? 1e-12 : 2 * 3 * 4 * dt * mu));
      CHECK(now.energy < last.energy + 1e-9);
    }
  };
  const Rigid3d::Coord left{{-0.6, 0, 0}, Eigen::Quaterniond::Identity()},
      right{{0.6, 0.3, 0.1}, Eigen::Quaterniond::Identity()};
  for (const double mu : {0.0, 0.4}) {
    INFO(mu);
    auto two = constrained_scene(skin,
                                 mu,
                                 balls_node<"a">({left}, {moving({2, 0, 0}, {0, 0, 3})}),
                                 balls_node<"b">({right}, {moving({-2, 0, 0})}));
    impact(two, mu, [](auto& sim, Motion& m) {
      m.add(sim.template at<"a">().state());
      m.add(sim.template at<"b">().state());
    });
    CHECK((two.at<"a">().state().velocity[0] - moving({2, 0, 0}, {0, 0, 3})).norm() > 1);
    auto one = constrained_scene(
        skin, mu, balls_node<"a">({left, right}, {moving({2, 0, 0}, {0, 0, 3}), moving({-2, 0, 0})}));
    impact(one, mu, [](auto& sim, Motion& m) { m.add(sim.template at<"a">().state()); });
    // they are the same bodies
    CHECK((one.at<"a">().state().velocity[0] - two.at<"a">().state().velocity[0]).norm() < 1e-12);
  }
}

TEST_CASE("energy never grows where balls fall onto each other, and two runs have the same bits") {
  std::vector<Rigid3d::Coord> places;
  std::vector<Rigid3d::Deriv> velocities;
  for (int i = 0; i < 12; ++i) {
    places.push_back({{0.35 * (i % 3) - 0.3 + 0.01 * i, 0.4 * (i % 2) - 0.013 * i, 0.6 + 1.05 * i},
                      Eigen::Quaterniond::Identity()});
    velocities.push_back(moving({0.3 * (i % 4), -0.2 * (i % 3), 0}, {1.0 * (i % 2), 0, 2}));
  }
  auto run = [&] {
    auto sim = constrained_scene(near_by(), 0.4, fixed_floor(), balls_node<"balls">(places, velocities));
    sim.root().get<BlockGaussSeidelConstraintSolver>().tolerance = 1e-9;
    sim.init();
    auto const& s = sim.at<"balls">().state();
    Motion last;
    last.add(s, g);
    const double first = last.energy;
    double highest = 0;
    for (int i = 0; i < 300; ++i) {
      sim.animate(dt);
      Motion now;
      now.add(s, g);
      highest = std::max(highest, now.energy - last.energy);
      last = now;
    }
    CHECK(highest < 1e-5);  // of some 1600 J
    CHECK(last.energy < first / 4);
    return std::pair(s.position, s.velocity);
  };
  const auto first = run(), second = run();
  CHECK(first.first == second.first);
  CHECK(first.second == second.second);
}

TEST_CASE("a contact of what moves apart has no force, and one of what cannot move none either") {
  const Rigid3d::Coord low{{0, 0, 0.52}, Eigen::Quaterniond::Identity()},
      side{{3, 0, 0.51}, Eigen::Quaterniond::Identity()};
  auto sim = constrained_scene(near_by(),
                               0.5,
                               fixed_floor(),
                               balls_node<"up">({low}, {moving({1, 0, 3})}),
                               node<"fixed">(EulerExplicitSolver{},
                                             MechanicalObject<Rigid3d>{.position = {side}},
                                             UniformMass<Rigid3d>{.vertexMass = ball(2, 0.5)},
                                             FixedConstraint<Rigid3d>{.indices = {0}},
                                             SphereCollisionModel<Rigid3d>{.radius = 0.5}),
                               balls_node<"lies">({{{6, 0, 0.51}, Eigen::Quaterniond::Identity()}}, {}));
  sim.init();
  sim.animate(dt);
  auto const& manager = sim.root().get<DefaultContactManager>();
  REQUIRE(manager.contacts.size() == 3);
  CHECK(force_on(manager, "/root/up").isZero(0));
  CHECK(force_on(manager, "/root/fixed").isZero(0));
  CHECK((force_on(manager, "/root/lies") - Vector3d(0, 0, 2 * g)).norm() < 1e-9);
  CHECK((sim.at<"up">().state().velocity[0] - moving({1, 0, 3 - g * dt})).norm() < 1e-14);
  CHECK(sim.at<"fixed">().state().position[0].center == side.center);
}

TEST_CASE("a bullet does not pass a plate with continuous detection") {
  // 10 m in a step
  auto sim = constrained_scene(
      ContinuousIntersection{.alarmDistance = 0.1, .contactDistance = 0.01},
      0.5,
      fixed_floor(),
      node<"bullet">(EulerExplicitSolver{},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 6}}, .velocity = {{100, 0, -1000}}},
                     UniformMass<Vec3d>{.totalMass = 0.01},
                     PointCollisionModel<Vec3d>{}));
  sim.init();
  for (int i = 0; i < 5; ++i) {
    sim.animate(dt);
    CHECK(sim.at<"bullet">().state().position[0][2] > 0.01 - 1e-9);
  }
  CHECK(sim.at<"bullet">().state().position[0][2] == Approx(0.01).epsilon(1e-6));
}

}  // namespace test_contact_bodies
