// SPDX-License-Identifier: BSL-1.0
// The example's scene and loop, tick by tick without threads; the program runs them in real time.
#include "catch.hpp"
#include "haptics/scene.hpp"

namespace test_haptics {

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
  // down by 15 mm in a second: 10 mm of it from where the tip touches
  HandDevice hand{[](double time) {
    auto pose = examples::tool_start();
    pose.center[1] -= 0.015 * std::min(time, 1.0);
    return pose;
  }};
  Wrench end;
  double inTheAir = 0;
  auto sim = run(hand, 6, [&](double time, Wrench const& w, auto& now) {
    end = w;
    if (time < 0.2) inTheAir = std::max(inTheAir, examples::contact_force(now).norm());
  });
  CHECK(inTheAir == 0);
  auto& tool = sim.at<"tool">();
  auto& coupling = tool.get<VirtualCoupling<Rigid3d>>();
  Rigid3d::VecDeriv held(1, Rigid3d::Deriv::Zero());
  coupling.addForce({}, held, tool.state().position, tool.state().velocity);
  CHECK((end.force + held[0].head<3>()).norm() < 1e-6);  // on the hand, and on the tool
  CHECK(end.force[1] > 0.2);                             // up, and across by as little as the mesh is askew
  CHECK(std::abs(end.force[0]) < 0.05 * end.force[1]);
  // the contact of the tip and the block
  CHECK((examples::contact_force(sim) - end.force).norm() < 1e-5);
  // and the hand's grip, k (x_t - x)
  const Vector3d grip = 300 * (examples::tool_start().center - Vector3d(0, 0.015, 0) - hand.pose.center);
  CHECK((grip + end.force).norm() < 1e-5);
}

TEST_CASE("haptics: the force of a palpation has no jumps that a hand would feel") {
  HandDevice hand{examples::Palpation{}};
  Vector3d last = Vector3d::Zero();
  double jump = 0, maximum = 0, torque = 0;
  double deepest = 0;
  long touches = 0, lifts = 0;
  bool touched = false;
  run(hand, 10, [&](double, Wrench const& w, auto& sim) {
    const bool touching = examples::contact_force(sim).norm() > 0;
    touches += touching && !touched, lifts += touched && !touching;
    touched = touching;
    for (Contact const& c : sim.root().template get<DefaultContactManager>().contacts)
      deepest = std::min(deepest, c.distance);
    jump = std::max(jump, (w.force - last).norm());
    maximum = std::max(maximum, w.force.norm());
    torque = std::max(torque, w.torque.norm());
    last = w.force;
  });
  // seven times in 10 s it presses and lets go; skin that swings back may touch once more
  CHECK(touches >= 7);
  CHECK(lifts >= 7);
  // 1 N on a contact of 1000 N/m, which acts from 1 mm on
  CHECK(deepest > -0.001);
  CHECK(maximum > 0.3);
  CHECK(maximum < 2);
  CHECK(torque > 0);
  CHECK(torque < 0.2);
  // a step of the simulation brings a new state of the tool; steps of the force that it makes are small
  // beside the force: half of what a moving hand tells apart, 7 to 10 %
  CHECK(jump < 0.05 * maximum);
}

}  // namespace test_haptics
