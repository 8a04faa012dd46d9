// SPDX-License-Identifier: BSL-1.0
// The example's scene and loop, tick by tick without threads; the program runs them in real time.
#include "catch.hpp"
#include "haptics/scene.hpp"

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double tick = 1e-3, dt = 0.01;

template <class Hand, class Each>
auto run(Hand& hand, double seconds, Each&& each) {
  auto sim = examples::haptic_scene({.cells = 5});
  sim.init();
  HapticController controller;
  controller.deviceMass = hand.mass;
  controller.check();
  ToolState tool;
  for (long i = 0; i < std::lround(seconds / tick); ++i) {
    const double time = double(i) * tick;
    controller.observe(time, hand.read(time));
    if (i % 10 == 0) {
      tool = examples::haptic_step(sim, controller.reading.ahead(dt), dt);
      tool.time = time + dt;
    }
    if (i % 10 == 4) controller.accept(time, tool);
    hand.write(controller.wrench(time));
    each(time, hand.felt, sim);
  }
  return sim;
}

}  // namespace

TEST_CASE("haptics: what the hand feels is what the block pushes back with, once all is at rest") {
  HandDevice hand{[](double) {
    auto pose = examples::tool_start();
    pose.center[1] -= 0.012;
    return pose;
  }};
  Wrench end;
  auto sim = run(hand, 12, [&](double, Wrench const& w, auto&) { end = w; });
  auto& tool = sim.at<"tool">();
  auto& coupling = tool.get<VirtualCoupling<Rigid3d>>();
  Rigid3d::VecDeriv held(1, Rigid3d::Deriv::Zero());
  coupling.addForce({}, held, tool.state().position, tool.state().velocity);
  CHECK((end.force + held[0].head<3>()).norm() < 1e-6);  // on the hand, and on the tool
  CHECK(end.force[1] > 0.2);                             // up, and across by as little as the mesh is askew
  CHECK(std::abs(end.force[0]) < 0.05 * end.force[1]);
  // the springs of the tip
  auto& tip = sim.at<"tool/tip">().state();
  auto& block = sim.at<"block">();
  auto& springs = sim.root().get<StiffSpringForceField<Vec3d, Between<"block", "tool/tip">>>();
  Vec3d::VecDeriv onBlock(block.state().size(), Vector3d::Zero()), onTip(1, Vector3d::Zero());
  springs.addForce(
      {}, onBlock, onTip, block.state().position, tip.position, block.state().velocity, tip.velocity);
  CHECK((onTip[0] - end.force).norm() < 1e-5);
  // and the hand's grip, k (x_t - x)
  const Vector3d grip = 300 * (examples::tool_start().center - Vector3d(0, 0.012, 0) - hand.pose.center);
  CHECK((grip + end.force).norm() < 1e-5);
}

TEST_CASE("haptics: the force of a palpation has no jumps that a hand would feel") {
  HandDevice hand{examples::Palpation{}};
  Vector3d last = Vector3d::Zero();
  double jump = 0, most = 0, torque = 0;
  run(hand, 10, [&](double, Wrench const& w, auto&) {
    jump = std::max(jump, (w.force - last).norm());
    most = std::max(most, w.force.norm());
    torque = std::max(torque, w.torque.norm());
    last = w.force;
  });
  CHECK(most > 0.3);
  CHECK(most < 2);
  CHECK(torque > 0);
  CHECK(torque < 0.2);
  // a step of the simulation brings a new state of the tool; steps of the force that it makes are small
  // beside the force: half of what a moving hand tells apart, 7 to 10 %
  CHECK(jump < 0.05 * most);
}
