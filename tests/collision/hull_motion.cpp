// SPDX-License-Identifier: BSL-1.0
// Hulls that are fast, and the same scene as a typed and as a runtime tree.
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/convex_collision_model.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/from_typed.hpp>

#include "collision/contact_scene.hpp"
#include "hulls.hpp"

namespace test_hull_motion {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

struct Few : Registry<DefaultPipeline, BruteForceBroadPhase, BVHNarrowPhase, MinProximityIntersection,
                      Contacts, Gravity, EulerImplicitSolver, CGLinearSolver<>, MechanicalObject<Rigid3d>,
                      UniformMass<Rigid3d>, ConvexCollisionModel<Rigid3d>, MechanicalObject<Vec3d>,
                      MeshTopology, TriangleCollisionModel<Vec3d>> {};

/// A box that flies at `speed` along -z towards a plate 2 cm thick, 1 m below.
template <class Intersection>
auto bullet(Intersection method, double speed, HullRotation const& rotation, double dt = 0.01) {
  auto sim = contact_scene(method,
                           0,
                           node<"plate">(MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, 0})}},
                                         ConvexCollisionModel<Rigid3d>{.moving = false,
                                                                       .simulated = false,
                                                                       .contactStiffness = 1000,
                                                                       .points = box_corners({5, 5, 0.01})}),
                           box_node<"box">({rigid_at({0.3, 0.1, 1}, rotation)}, {0.1, 0.15, 0.2}, 1, 100));
  sim.init();
  sim.template at<"box">().state().velocity[0] << 0, 0, -speed, 0, 0, 0;
  double lowest = 1;
  for (int i = 0; i < 200; ++i) {
    sim.animate(dt);
    lowest = std::min(lowest, sim.template at<"box">().state().position[0].center[2]);
  }
  return lowest;
}
constexpr ContinuousIntersection tight{.alarmDistance = 0.02, .contactDistance = 0.01};
constexpr MinProximityIntersection coarse{.alarmDistance = 0.02, .contactDistance = 0.01};

}  // namespace

TEST_CASE("a fast hull does not pass through a thin plate under ContinuousIntersection") {
  const HullRotation flat{0.4, {0, 0, 1}}, askew{0.4, {1, 2, 3}};
  // at 0.7 to 10 m in a step
  for (const double speed : {70.0, 170.0, 1000.0}) {
    INFO(speed);
    CHECK(bullet(coarse, speed, flat) < -1);
    CHECK(bullet(tight, speed, flat) > 0.2);
  }
  // a corner that hits first would make it turn
  CHECK(bullet(coarse, 40, askew) < -1);
  for (const double speed : {10.0, 40.0, 70.0, 170.0, 1000.0}) {
    INFO(speed);
    CHECK(bullet(tight, speed, askew) > 0.1);
  }
  CHECK(bullet(tight, 100, askew, 0.003) > 0.1);
}

TEST_CASE("the tip of a bar that spins meets what it sweeps over, in between two steps") {
  // the tip, 1 m away, goes through 1 rad a step; the ball lies at 0.5 rad
  auto contacts = [](auto method) {
    auto sim = contact_scene(
        method,
        0,
        node<"ball">(MechanicalObject<Vec3d>{.position = {V(std::cos(0.5), std::sin(0.5), 0) * 0.9}},
                     SphereCollisionModel<Vec3d>{.moving = false, .simulated = false, .radius = 0.02}),
        box_node<"bar">({rigid_at({0, 0, 0})}, {1, 0.02, 0.02}, 1, 100));
    sim.init();
    sim.template at<"bar">().state().velocity[0] << 0, 0, 0, 0, 0, 100;
    sim.animate(0.01);
    return sim.root().template get<Contacts>().contacts;
  };
  CHECK(contacts(coarse).empty());
  const auto found = contacts(tight);
  REQUIRE(found.size() == 1);
  // it is the long side that hits, 0.01 m before
  const Contact& c = found[0];
  CHECK(c.b.lever[1] == Approx(0.02).margin(1e-9));
  CHECK(c.b.lever[0] == Approx(std::sqrt(0.81 - 0.05 * 0.05)).margin(1e-4));
}

TEST_CASE("a runtime tree has hulls where its registry has them, to the same bits") {
  auto typed = contact_scene(
      MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.05},
      10,
      floor_node(50, 0.5),
      box_node<"boxes">({rigid_at({0.3, 0.2, 0.54}), rigid_at({0.4, 0.1, 1.58}, {0.3, {0, 0, 1}})},
                        {0.5, 0.5, 0.5},
                        3,
                        50));
  auto runtime = Simulation(to_runtime<Few>(typed.root()));
  typed.init();
  runtime.init();
  for (int i = 0; i < 50; ++i) typed.animate(0.01), runtime.animate(0.01);
  auto const& expected = typed.at<"boxes">().state().position;
  const NoScope above;
  traverse(decltype(runtime)::RootScope{runtime.root(), above},
           on<role::State>([&](auto& state, auto const&) {
             if constexpr (std::is_same_v<std::decay_t<decltype(state)>, MechanicalObject<Rigid3d>>) {
               REQUIRE(state.position.size() == 2);
               for (std::size_t i = 0; i < 2; ++i) {
                 CHECK(state.position[i].center == expected[i].center);
                 CHECK(state.position[i].orientation.coeffs() == expected[i].orientation.coeffs());
               }
             }
           }));
  CHECK(std::abs(expected[1].center[2] - 1.58) > 1e-3);
}

}  // namespace test_hull_motion
