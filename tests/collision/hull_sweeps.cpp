// SPDX-License-Identifier: BSL-1.0
// Hulls that are fast and turn, and those that are driven, under ContinuousIntersection.
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/convex_collision_model.hpp>

#include <random>

#include "collision/contact_scene.hpp"
#include "hulls.hpp"

namespace test_hull_sweeps {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {
constexpr ContinuousIntersection tight{.alarmDistance = 0.02, .contactDistance = 0.01};
}

TEST_CASE("no turn, spin or speed takes a hull through a plate or a triangle under ContinuousIntersection",
          "[long]") {
  // a box between a plate and a sheet, at up to 3e4 m/s and 50 rad/s: its centre stays in between for as long
  // as it is over both. Stopped from v, a contact is v dt/(1 + k dt^2/m) deep: here 3e-5 m. (Above 100 rad/s
  // the free rotation, a radian a step, is itself not stable.)
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  auto any = [&] {
    V x;
    for (int i = 0; i < 3; ++i) x[i] = unit(random);
    return x;
  };
  MeshTopology topology;
  topology.triangles = {{0, 2, 1}};
  auto sim = contact_scene(
      tight,
      0,
      node<"plate">(MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, 0})}},
                    ConvexCollisionModel<Rigid3d>{.moving = false,
                                                  .simulated = false,
                                                  .contactStiffness = 1e5,
                                                  .points = box_corners({50, 50, 0.01})}),
      node<"sheet">(
          topology,
          MechanicalObject<Vec3d>{.position = {{-90, -90, 9}, {90, -90, 9}, {0, 180, 9}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactStiffness = 1e5}),
      box_node<"box">({rigid_at({0.3, 0.1, 4})}, {0.1, 0.15, 0.2}, 1, 1e4));
  sim.init();
  auto& box = sim.at<"box">().state();
  int steps = 0, through = 0;
  for (int k = 0; k < 300; ++k) {
    sim.reset();
    const V place = V(0, 0, 4.5) + any(), axis = any(), spin = 30 * any();
    const double speed = unit(random) * std::pow(10, 2.5 + 2 * unit(random));
    box.position[0] = rigid_at(place, {3 * unit(random), axis});
    box.velocity[0] << speed * V(0.05 * unit(random), 0.05 * unit(random), 1), spin;
    for (int i = 0; i < 30; ++i) {
      sim.animate(0.01);
      V const& x = box.position[0].center;
      if (std::abs(x[0]) > 45 || std::abs(x[1]) > 45) break;
      ++steps;
      if (!(x[2] > 0 && x[2] < 9)) ++through;
    }
  }
  CHECK(through == 0);
  CHECK(steps > 4000);
}

TEST_CASE("a driven hull takes along what it sweeps over") {
  // a plate 2 cm thick goes by 0.5 m a step; a ball of 1 cm lies in its way
  auto sim = contact_scene(
      tight,
      0,
      node<"plate">(MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, -1.23})}},
                    ConvexCollisionModel<Rigid3d>{
                        .simulated = false, .contactStiffness = 1000, .points = box_corners({1, 1, 0.01})}),
      box_node<"ball">({rigid_at({0, 0, 0}, {0.3, {1, 2, 3}})}, {0.01, 0.01, 0.01}, 0.1, 100));
  sim.init();
  auto& plate = sim.at<"plate">().state();
  for (int i = 0; i < 10; ++i) {
    plate.position[0].center[2] += 0.5;
    plate.velocity[0] << 0, 0, 50, 0, 0, 0;
    sim.animate(0.01);
    if (plate.position[0].center[2] > 0)
      CHECK(sim.at<"ball">().state().position[0].center[2] > plate.position[0].center[2]);
  }
}

TEST_CASE("two free hulls that fly at each other meet, and keep their momentum and no more energy") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  auto any = [&] {
    V x;
    for (int i = 0; i < 3; ++i) x[i] = unit(random);
    return x;
  };
  auto sim = contact_scene(
      tight, 0, box_node<"boxes">({rigid_at({-2, 0, 0}), rigid_at({2, 0, 0})}, {0.1, 0.15, 0.2}, 1, 1e4));
  sim.init();
  auto& boxes = sim.at<"boxes">().state();
  for (int k = 0; k < 100; ++k) {
    INFO(k);
    sim.reset();
    const double speed = std::pow(10, 2.5 + 1.5 * unit(random));
    for (std::size_t i = 0; i < 2; ++i) {
      const double side = i == 0 ? -1 : 1;
      boxes.position[i] = rigid_at(V(2 * side, 0, 0), {3 * unit(random), any()});
      boxes.velocity[i] << -side * speed, 0, 0, V(10 * any());
    }
    // the moments of inertia are those of a box of 1 kg, at most 0.021 kg m^2
    const double energy =
        speed * speed +
        0.5 * 0.021 * (boxes.velocity[0].tail<3>().squaredNorm() + boxes.velocity[1].tail<3>().squaredNorm());
    for (int i = 0; i < 20; ++i) sim.animate(0.01);
    auto const &v0 = boxes.velocity[0], &v1 = boxes.velocity[1];
    // centre to centre they cannot miss; what the normal leaves of the velocity they glance off with
    CHECK((v0.head<3>() - V(speed, 0, 0)).norm() > 0.1 * speed);
    CHECK((v0 + v1).head<3>().norm() < 1e-9 * speed);
    CHECK(0.5 * (v0.head<3>().squaredNorm() + v1.head<3>().squaredNorm()) < energy);
  }
}

}  // namespace test_hull_sweeps
