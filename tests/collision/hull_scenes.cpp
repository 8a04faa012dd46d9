// SPDX-License-Identifier: BSL-1.0
// Hulls in the collision pipeline: what stands, slides, and is stopped.
#include <sinew/collision/convex_collision_model.hpp>

#include "collision/contact_scene.hpp"
#include "hulls.hpp"

namespace test_hull_scenes {

using namespace sinew;

namespace {
constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.05};
}

TEST_CASE("a box dropped askew comes to stand on its four corners, as deep as they are stiff") {
  auto sim = contact_scene(
      near,
      10,
      floor_node(2000, 0.3),
      box_node<"box">({rigid_at({0.3, 0.2, 0.5 + 0.2}, {0.2, {1, 0.5, 0}})}, {0.5, 0.5, 0.5}, 3, 10));
  sim.init();
  for (int i = 0; i < 2000; ++i) sim.animate(0.005);
  auto const& x = sim.at<"box">().state().position[0];
  CHECK(sim.root().get<Contacts>().contacts.size() == 4);
  // four corners carry 30 N: each is 30/4/k deep, k = 2000 * 10 / 0.05
  CHECK(x.center[2] == Approx(0.55 - 30 / 4.0 / (2000 * 10 / 0.05)).margin(1e-8));
  const Eigen::Vector3d up = x.orientation * Eigen::Vector3d::UnitZ();
  CHECK(std::abs(up[2]) == Approx(1).margin(1e-9));
  CHECK(sim.at<"box">().state().velocity[0].norm() < 1e-7);
}

TEST_CASE("a stack of three boxes stands without creeping, each carrying what is above", "[long]") {
  // the second and the third lie shifted and turned on those below; polygons of up to 8 corners
  auto sim = contact_scene(near,
                           10,
                           floor_node(50, 0.5),
                           box_node<"boxes">({rigid_at({0.3, 0.2, 0.54}),
                                              rigid_at({0.4, 0.1, 1.58}, {0.3, {0, 0, 1}}),
                                              rigid_at({0.3, 0.2, 2.62}, {0.5, {0, 0, 1}})},
                                             {0.5, 0.5, 0.5},
                                             3,
                                             50,
                                             20,
                                             0.25));
  sim.init();
  for (int i = 0; i < 1500; ++i) sim.animate(0.01);
  const auto settled = sim.at<"boxes">().state().position;
  for (int i = 0; i < 1500; ++i) sim.animate(0.01);
  auto const& x = sim.at<"boxes">().state().position;
  CHECK(sim.root().get<Contacts>().contacts.size() > 12);
  // the lowest carries 90 N on four corners
  CHECK(x[0].center[2] == Approx(0.55 - 90 / (4 * 50 * 50 / 0.05)).margin(1e-8));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK((x[i].center - settled[i].center).norm() < 1e-9);
    CHECK(x[i].orientation.angularDistance(settled[i].orientation) < 1e-9);
  }
}

TEST_CASE("an aligned stack is as deep as weight over stiffness", "[long]") {
  auto sim = contact_scene(
      near,
      10,
      floor_node(50, 0.5),
      box_node<"boxes">({rigid_at({0.3, 0.2, 0.54}), rigid_at({0.3, 0.2, 1.58}), rigid_at({0.3, 0.2, 2.62})},
                        {0.5, 0.5, 0.5},
                        3,
                        50));
  sim.init();
  for (int i = 0; i < 3000; ++i) sim.animate(0.01);
  auto const& x = sim.at<"boxes">().state().position;
  // four corners each, k = 50 * 50 / 0.05
  const double k = 4 * 50 * 50 / 0.05;
  double height = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    height += (i == 0 ? 0.55 : 1.05) - double(3 - i) * 30 / k;
    CHECK(x[i].center[2] == Approx(height).margin(1e-8));
    CHECK((x[i].center.head<2>() - Eigen::Vector2d(0.3, 0.2)).norm() < 1e-6);
  }
}

TEST_CASE("a stiff stack that starts deep in itself and the floor gains no energy, and comes to rest",
          "[long]") {
  const double m = 3, g = 10, dt = 0.01;
  for (const double k : {2e6, 2e7})  // k dt^2/m = 67, 667
    for (const double depth : {0.0, 0.001, 0.01})
      for (const double askew : {0.0, 1.0}) {
        INFO(k << " " << depth << " " << askew);
        const double each = std::sqrt(k * 0.05);
        auto sim = contact_scene(
            near,
            g,
            floor_node(each, 0.25),
            box_node<"boxes">(
                {rigid_at({0.3, 0.2, 0.55 - depth}),
                 rigid_at({0.3 + 0.1 * askew, 0.2 - 0.1 * askew, 1.6 - 2 * depth}, {0.3 * askew, {0, 0, 1}}),
                 rigid_at({0.3, 0.2, 2.65 - 3 * depth}, {0.5 * askew, {0, 0, 1}})},
                {0.5, 0.5, 0.5},
                m,
                each,
                0,
                0.25));
        sim.init();
        auto const& state = sim.at<"boxes">().state();
        auto mechanical = [&] {
          double e = 0;
          for (std::size_t i = 0; i < 3; ++i)
            e += m / 2 * state.velocity[i].head<3>().squaredNorm() +
                 m / 12 * state.velocity[i].tail<3>().squaredNorm() +
                 m * g * (state.position[i].center[2] - 0.55 - 1.05 * double(i));
          return e;
        };
        // of three bodies that move by v, 2 v, 3 v
        auto kinetic = [&](double v) { return m / 2 * v * v * (1 + 4 + 9); };
        // of the 12 k depth^2/2 = 1,200 and 12,000 J in the contacts one step leaves what it takes to bring
        // the bodies out
        sim.animate(dt);
        const double start = mechanical(), hops = kinetic(2 * g * dt);
        CHECK(start < kinetic(depth / dt));
        double last = start, maximum = -1, late = -1, speed = 0;
        for (int i = 1; i < 800; ++i) {
          sim.animate(dt);
          const double now = mechanical();
          // a body may fall g dt^2 deep in a step, and is brought out in the next
          CHECK(now < last + hops);
          maximum = std::max(maximum, now);
          last = now;
          if (i < 600) continue;
          late = std::max(late, now);
          for (std::size_t b = 0; b < 3; ++b)
            speed = std::max(speed, state.velocity[b].norm() / double(b + 1));
        }
        CHECK(maximum < std::max(start, hops));
        CHECK(late < 1e-9);
        CHECK(speed < 1e-9);
        CHECK((state.position[2].center - Eigen::Vector3d(0.3, 0.2, 2.65)).norm() < 6 * 2 * g * dt * dt);
      }
}

TEST_CASE("a box on a slope holds up to the angle of Coulomb, and slides beyond") {
  const double friction = 0.5, critical = std::atan(friction);
  auto on_slope = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle), up = 0.25 + 0.0499;
    return contact_scene(
        near,
        10,
        floor_node(1000, friction, angle),
        box_node<"box">({rigid_at({-s * up, 0.1, c * up}, {-angle, {0, 1, 0}})}, {0.5, 0.4, 0.25}, 2, 1, 10));
  };
  SECTION("below") {
    auto sim = on_slope(critical - 0.01);
    sim.init();
    for (int i = 0; i < 300; ++i) sim.animate(0.01);
    const auto settled = sim.at<"box">().state().position[0];
    for (int i = 0; i < 2000; ++i) sim.animate(0.01);
    CHECK((sim.at<"box">().state().position[0].center - settled.center).norm() < 1e-6);
  }
  SECTION("above") {
    const double angle = critical + 0.02;
    auto sim = on_slope(angle);
    sim.init();
    const double a = 10 * (std::sin(angle) - friction * std::cos(angle));
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v0 = sim.at<"box">().state().velocity[0].head<3>().norm();
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v1 = sim.at<"box">().state().velocity[0].head<3>().norm();
    CHECK((v1 - v0) / 2 == Approx(a).epsilon(0.01));
  }
}

TEST_CASE("a round can stands on 8 places of its rim", "[long]") {
  std::vector<Eigen::Vector3d> rim;
  for (int k = 0; k < 40; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / 40;
    for (const double z : {-0.4, 0.4}) rim.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle), z});
  }
  auto sim = contact_scene(
      near,
      10,
      floor_node(50, 0.3),
      node<"can">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
          MechanicalObject<Rigid3d>{.position = {rigid_at({0.3, 0.2, 0.449})}},
          UniformMass<Rigid3d>{
              .vertexMass = RigidMass<double, 3>{2, Eigen::Matrix3d(0.2 * Eigen::Matrix3d::Identity())}},
          ConvexCollisionModel<Rigid3d>{.contactStiffness = 50, .contactDamping = 50, .points = rim}));
  sim.init();
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  const auto settled = sim.at<"can">().state().position[0];
  for (int i = 0; i < 500; ++i) sim.animate(0.01);
  auto const& x = sim.at<"can">().state().position[0];
  CHECK((x.center - settled.center).norm() < 1e-9);
  const Eigen::Vector3d up = x.orientation * Eigen::Vector3d::UnitZ();
  CHECK((up - Eigen::Vector3d::UnitZ()).norm() < 1e-4);
  const std::size_t contacts = sim.root().get<Contacts>().contacts.size();
  CHECK(contacts >= 7);
  CHECK(contacts <= 16);  // 8 for each triangle of the floor
}

}  // namespace test_hull_scenes
