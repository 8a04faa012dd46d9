// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/control/hand_device.hpp>
#include <sinew/control/scripted_device.hpp>
#include <sinew/control/trajectory_device.hpp>

#include <numbers>

namespace test_haptic_devices {

using namespace sinew;
using Eigen::Vector3d;

namespace {

Rigid3d::Coord at(Vector3d const& x, Vector3d const& rotation = Vector3d::Zero()) {
  Rigid3d::Coord pose;
  Rigid3d::Deriv d;
  d << x, rotation;
  Rigid3d::increment(pose, d);
  return pose;
}
double distance(Rigid3d::Coord const& a, Rigid3d::Coord const& b) { return Rigid3d::difference(a, b).norm(); }

auto still(Rigid3d::Coord const& pose) {
  return HandDevice{[pose](double) { return pose; }};
}

}  // namespace

static_assert(HapticDevice<TrajectoryDevice>);
static_assert(HapticDevice<ScriptedDevice<DeviceState (*)(double)>>);
static_assert(HapticDevice<HandDevice<Rigid3d::Coord (*)(double)>>);
static_assert(!HapticDevice<Wrench>);

TEST_CASE("a trajectory is replayed: straight lines, constant turns, buttons, from the start again") {
  const Vector3d rotation(0, 0, 1.2);
  const std::vector<TrajectoryDevice::Sample> samples{
      {1, {at({0, 0, 0}), 0}}, {2, {at({1, 2, 3}, rotation), 3}}, {4, {at({1, 2, 5}, rotation), 0}}};
  TrajectoryDevice once(samples);
  CHECK(distance(once.read(0).pose, at({0, 0, 0})) == 0);
  CHECK(distance(once.read(1.25).pose, at({0.25, 0.5, 0.75}, 0.25 * rotation)) < 1e-15);
  CHECK(once.read(1.99).buttons == 0);
  CHECK(once.read(2).buttons == 3);
  CHECK(distance(once.read(2).pose, samples[1].state.pose) < 1e-15);
  CHECK(distance(once.read(3).pose, at({1, 2, 4}, rotation)) < 1e-15);
  CHECK(distance(once.read(9).pose, at({1, 2, 5}, rotation)) == 0);
  TrajectoryDevice again(samples, true);
  CHECK(distance(again.read(4.25).pose, once.read(1.25).pose) < 1e-14);
  CHECK(distance(again.read(303).pose, once.read(3).pose) < 1e-12);
  once.write({{1, 2, 3}, {4, 5, 6}});
  CHECK(once.felt.torque == Vector3d(4, 5, 6));

  auto replay = [](std::vector<TrajectoryDevice::Sample> all) { TrajectoryDevice device(all); };
  one::says([] { TrajectoryDevice(std::vector<TrajectoryDevice::Sample>{}); }, {"no sample"});
  one::says([&] { TrajectoryDevice({samples[1], samples[0]}); }, {"sample 1 is at 1 s", "sort"});
  one::says([&] { replay({{one::notANumber, {}}}); }, {"sample 0", "not finite"});
  one::says([&] { replay({{0, {at({0, one::notANumber, 0}), 0}}}); }, {"not finite"});
  one::says([&] { replay({{0, {{{0, 0, 0}, {0, 0, 0, 0}}, 0}}}); }, {"unit quaternion"});
}

TEST_CASE("a script is where it says") {
  ScriptedDevice device{[](double t) { return DeviceState{at({t, 0, 0}), t > 1 ? 1u : 0u}; }};
  CHECK(device.read(2).pose.center == Vector3d(2, 0, 0));
  CHECK(device.read(2).buttons == 1);
  device.write({{1, 0, 0}, {0, 0, 0}});
  CHECK(device.felt.force[0] == 1);
}

TEST_CASE("a hand yields to a force by F / k, and turns by torque / k") {
  auto hand = still(at({0.1, 0.2, 0.3}, {0, 0.5, 0}));
  for (int i = 0; i <= 20000; ++i) {
    hand.read(1e-3 * i);
    hand.write({{3, 0, -6}, {0, 0.02, 0}});
  }
  // e^-25t is the slowest decay
  CHECK(distance(hand.pose, at({0.1 + 3. / 300, 0.2, 0.3 - 6. / 300}, {0, 0.52, 0})) < 1e-12);
  CHECK(hand.velocity.norm() < 1e-12);
  // what is stored in the grip, F^2 / 2k
  CHECK(hand.energy() == Approx(45 / 600. + 4e-4 / 2).epsilon(1e-9));
}

TEST_CASE("a hand rings as a damped oscillator, whatever the ticks") {
  // x = e^(-a t) cos(w t) x0 + (v0 + a x0) / w e^(-a t) sin(w t)
  const double m = 0.2, k = 80, c = 1, b = 0.6, x0 = 0.01, v0 = -0.3;
  const double a = (c + b) / (2 * m), w = std::sqrt(k / m - a * a);
  for (const double dt : {1e-4, 1e-3, 0.03}) {
    auto hand = still({});
    hand.mass = m, hand.stiffness = k, hand.damping = c, hand.deviceDamping = b;
    hand.inertia = m, hand.angularStiffness = k, hand.angularDamping = c, hand.deviceAngularDamping = b;
    hand.pose = at({x0, 0, 0}, {0, x0, 0});
    hand.velocity << v0, 0, 0, 0, v0, 0;
    hand.read(0);
    double worst = 0;
    for (int i = 1; i * dt < 1; ++i) {
      const double t = i * dt;
      const double x = std::exp(-a * t) * (x0 * std::cos(w * t) + (v0 + a * x0) / w * std::sin(w * t));
      worst = std::max(worst, distance(hand.read(t).pose, at({x, 0, 0}, {0, x, 0})));
    }
    CHECK(worst < 1e-13);  // rounding, from tick to tick
  }
}

TEST_CASE("a hand that nobody holds falls freely under a force, and stops by friction") {
  auto hand = still({});
  hand.stiffness = hand.damping = hand.angularStiffness = hand.angularDamping = 0;
  for (int i = 0; i <= 1000; ++i) {
    hand.read(1e-3 * i);
    hand.write({{0, 0.2, 0}, {0, 0, 0}});
  }
  CHECK(hand.pose.center[1] == Approx(0.5 * 0.2 / 0.1).epsilon(1e-12));
  CHECK(hand.velocity[1] == Approx(0.2 / 0.1).epsilon(1e-12));
  // work of a constant force, all of it in motion
  CHECK(hand.work == Approx(0.2 * hand.pose.center[1]).epsilon(1e-12));
  CHECK(hand.energy() == Approx(hand.work).epsilon(1e-10));
  hand.deviceDamping = 0.5;
  hand.write({});
  hand.step = 0;
  const double x = hand.pose.center[1], v = hand.velocity[1];
  for (int i = 1001; i <= 11000; ++i) hand.read(1e-3 * i);
  CHECK(hand.pose.center[1] - x == Approx(v * 0.1 / 0.5).epsilon(1e-10));  // m v / b
}

TEST_CASE("a hand follows a target at constant speed, behind by b v / k") {
  HandDevice hand{[](double t) { return at({0.3 * t, 0, 0}); }};
  hand.deviceDamping = 2;
  for (int i = 0; i <= 10000; ++i) hand.read(1e-3 * i);
  CHECK(hand.pose.center[0] == Approx(3 - 2 * 0.3 / 300).epsilon(1e-12));
}

TEST_CASE("a hand refuses what it cannot be") {
  auto hand = still({});
  hand.mass = 0;
  one::says([&] { hand.read(0); }, {"HandDevice", "mass is 0 kg", "greater than 0"});
  hand.mass = 1, hand.stiffness = -1;
  one::says([&] { hand.read(0); }, {"stiffness is -1", "at least 0"});
  hand.stiffness = one::notANumber;
  one::says([&] { hand.read(0); }, {"stiffness is nan"});
}

}  // namespace test_haptic_devices
