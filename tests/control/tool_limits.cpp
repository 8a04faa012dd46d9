// SPDX-License-Identifier: BSL-1.0
// A haptic loop on a tool whose contacts are answered by multipliers, at two rates without threads: ticks of
// 1 ms, steps of 20 ms whose result is there 10 ms after they began.
#include "catch.hpp"
#include "control/two_rates.hpp"
#include "lagrangian/contact_scenes.hpp"

#include <sinew/control/hand_device.hpp>
#include <sinew/control/tool_limits.hpp>
#include <sinew/force/virtual_coupling.hpp>

#include <limits>

namespace test_tool_limits {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double radius = 0.005, wall = 0.02;  // m; the surface of the tool meets the wall at x = 0.02
constexpr double skin = 0.001, free_way = wall - radius - skin;

/// A tool of 0.05 kg on a coupling, with a ball that may touch a wall across x.
auto tool() {
  MeshTopology quad;
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  const RigidMass<double, 3> mass{0.05, 1e-4 * Eigen::Matrix3d::Identity()};
  auto sim = constrained_scene_by(
      BlockGaussSeidelConstraintSolver{.maxIterations = 1000, .tolerance = 1e-12},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = skin},
      0,
      node<"wall">(
          quad,
          MechanicalObject<Vec3d>{.position = {{wall, -1, -1}, {wall, -1, 1}, {wall, 1, 1}, {wall, 1, -1}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = true}),
      node<"tool">(EulerImplicitSolver{},
                   SparseLDLSolver<CompressedRowSparseMatrixd>{},
                   MechanicalObject<Rigid3d>{.position = {{}}},
                   UniformMass<Rigid3d>{.vertexMass = mass},
                   VirtualCoupling<Rigid3d>{},
                   node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                               RigidMapping<Rigid3d, Vec3d>{},
                               SphereCollisionModel<Vec3d>{.radius = radius})));
  sim.root().template get<Gravity>().gravity.setZero();
  return sim;
}

struct Felt {
  double end = 0;   // the last force [N]
  double tool = 0;  // the last place of the tool [m]
  double early = 0,
         late = 0;  // the largest energy of the device in the first second, and in the last one [J]
};

/// Runs for a time with a controller, with or without the limits of the tool.
template <class Hand>
Felt run(Hand& hand, HapticController c, double seconds, bool limited) {
  auto sim = tool();
  Felt felt;
  at_two_rates(
      sim,
      sim.template at<"tool">().template get<VirtualCoupling<Rigid3d>>(),
      hand,
      c,
      0.02,
      seconds,
      [&](auto& scene) {
        auto const& s = scene.template at<"tool">().state();
        ToolState result{s.position[0], s.velocity[0]};
        if (limited)
          add_tool_limits(result, scene.root().template get<DefaultContactManager>(), "/root/tool");
        REQUIRE(s.position[0].center[0] < free_way + 1e-9);
        felt.tool = s.position[0].center[0];
        return result;
      },
      [&](double time, Wrench const& w) {
        felt.end = w.force[0];
        if (time < 1) felt.early = std::max(felt.early, hand.energy());
        if (time > seconds - 1) felt.late = std::max(felt.late, hand.energy());
      });
  return felt;
}

Rigid3d::Coord beyond(double) {
  Rigid3d::Coord pose;
  pose.center = {0.05, 0, 0};
  return pose;
}
Rigid3d::Coord origin(double) { return {}; }

}  // namespace

TEST_CASE("a hand that presses a tool against a wall by multipliers rests where hand and coupling balance") {
  for (const bool limited : {false, true}) {
    HandDevice hand{&beyond};
    hand.pose.center = {1e-12, 0, 0};  // starts at the tool
    const double K = 240, k = 300;     // K h^2 = 2 m, the rule of docs/haptics.md
    const Felt felt = run(hand, {.stiffness = K}, 20, limited);
    // the tool is at the wall; of the hand's 5 cm two springs in a row have the rest
    CHECK(felt.tool == Approx(free_way));
    CHECK(felt.end == Approx(-(0.05 - free_way) / (1 / k + 1 / K)).epsilon(1e-6));
  }
}

TEST_CASE("a device that nobody holds, thrown at a wall by multipliers, gains no energy") {
  HapticController c{.stiffness = 240, .angularStiffness = 0.24};
  HandDevice hand{&origin};
  hand.mass = c.deviceMass, hand.inertia = c.deviceInertia;
  hand.stiffness = hand.damping = hand.angularStiffness = hand.angularDamping = 0;
  hand.velocity << 0.1, 0, 0, 0, 0, 0;
  const Felt felt = run(hand, c, 30, true);
  CHECK(felt.early < 1.01 * 0.5 * c.deviceMass * 0.1 * 0.1);
  CHECK(felt.late < felt.early);
}

TEST_CASE("between two steps, limits keep a tool from where the simulation would not let it go") {
  HapticController c{.stiffness = 1000, .damping = 0, .angularStiffness = 0.5, .angularDamping = 0};
  c.rampTime = 0, c.maxForce = c.maxTorque = 1e9;
  c.observe(0, DeviceState{});
  ToolState tool;
  tool.velocity << 0.3, 0.1, 0, 0, 0, 2;
  // without limits, 10 ms later it is 3 mm, 1 mm and 0.02 rad on
  auto felt = [&] {
    c.accept(0, tool);
    return c.wrench(0.01);
  };
  CHECK((felt().force - Vector3d(3, 1, 0)).norm() < 1e-9);
  CHECK(felt().torque[2] == Approx(0.01));
  // a wall 1 mm ahead of its centre
  ToolLimit ahead;
  ahead.direction << -1, 0, 0, 0, 0, 0;
  ahead.distance = 1e-3;
  tool.add(ahead);
  CHECK((felt().force - Vector3d(1, 1, 0)).norm() < 1e-9);
  CHECK(felt().torque[2] == Approx(0.01));
  // a corner of two walls, whatever their order, the second met at a place 0.02 m beside the centre
  tool.limits[0].distance = 2e-3;
  ToolLimit beside;
  const Vector3d n = Vector3d(-1, -1, 0).normalized(), r(0.02, 0, 0);
  beside.direction << n, r.cross(n);
  tool.add(beside);
  const Wrench one = felt();
  std::swap(tool.limits[0], tool.limits[1]);
  const Wrench other = felt();
  CHECK((one.force - other.force).norm() < 1e-5);
  // what is felt is the coupling to a way that keeps both, nearest by its energy: the first wall is not
  // reached
  Rigid3d::Deriv way = 0.01 * tool.velocity, inverse;
  inverse << 1e-3, 1e-3, 1e-3, 2, 2, 2;
  const double f = -beside.direction.dot(way) / beside.direction.dot(inverse.cwiseProduct(beside.direction));
  way += f * inverse.cwiseProduct(beside.direction);
  REQUIRE(way[0] < 2e-3);
  CHECK((one.force - 1000 * way.head<3>()).norm() < 1e-5);
  CHECK(one.torque[2] == Approx(0.5 * way[5]).epsilon(1e-6));
}

TEST_CASE(
    "limits of a tool that are not finite make a state that counts as none, and those that are farthest go "
    "first") {
  HapticController c;
  c.observe(0, DeviceState{});
  ToolState tool;
  ToolLimit wrong;
  wrong.direction[0] = std::numeric_limits<double>::quiet_NaN();
  tool.add(wrong);
  c.accept(0, tool);
  CHECK(c.badTools == 1);
  CHECK_FALSE(c.hasTool);
  ToolState many;
  for (std::size_t i = 0; i < ToolState::maxLimits + 2; ++i)
    many.add({Rigid3d::Deriv::Unit(0), i == 3 ? 9.0 : i == 5 ? 8.0 : double(i) / 100});
  CHECK(many.limitCount == ToolState::maxLimits);
  for (auto const& limit : many.limits) CHECK(limit.distance < 1);
}

}  // namespace test_tool_limits
