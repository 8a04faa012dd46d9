// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/control/hand_device.hpp>
#include <sinew/control/haptic_controller.hpp>

#include <random>

namespace test_haptic_controller {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double T = 1e-3;

Rigid3d::Coord at(double x, double rotation = 0) {
  Rigid3d::Coord pose;
  Rigid3d::Deriv d;
  d << x, 0, 0, 0, 0, rotation;
  Rigid3d::increment(pose, d);
  return pose;
}

/// No ramp, nothing clamped, no damping of the device: the coupling alone.
HapticController bare(HapticController c = {}) {
  c.rampTime = 0;
  c.maxForce = c.maxTorque = 1e9;
  c.staleTime = 1e9;
  return c;
}

/// One tick with the tool held at the origin.
Wrench tick(HapticController& c, double time, DeviceState const& device) {
  c.observe(time, device);
  if (!c.hasTool) c.accept(time, {});
  return c.wrench(time);
}

/// Largest energy of a device on a coupling to a tool that is held fast, early and late: the device starts
/// with a speed, and nobody holds it.
struct Energies {
  double early, late;
};
Energies let_go(HapticController c, double mass, double damping, long ticks) {
  HandDevice hand{[](double) { return Rigid3d::Coord{}; }};
  hand.mass = mass, hand.deviceDamping = damping;
  hand.inertia = 1e-3 * mass, hand.deviceAngularDamping = 1e-3 * damping;
  hand.stiffness = hand.damping = hand.angularStiffness = hand.angularDamping = 0;
  hand.velocity << 0.01, 0, 0, 0, 0, 0.1;
  Energies e{0, 0};
  for (int i = 0; i < ticks; ++i) {
    hand.write(tick(c, i * T, hand.read(i * T)));
    const Rigid3d::Deriv d = Rigid3d::difference({}, hand.pose);
    const double energy = hand.energy() + 0.5 * (c.stiffness * d.head<3>().squaredNorm() +
                                                 c.angularStiffness * d.tail<3>().squaredNorm());
    if (i < 1000) e.early = std::max(e.early, energy);
    if (i >= ticks - 1000) e.late = std::max(e.late, energy);
    if (energy > 1e6) return {e.early, energy};
  }
  return e;
}

/// Energy that a device of these joints gives to a hand that moves it by dx[i] from tick to tick, evenly
/// between; the tool is held fast.
std::vector<double> given(HapticController c, double damping, std::vector<double> const& dx) {
  std::vector<double> sums;
  double x = 0, sum = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    const double f = tick(c, double(i) * T, {at(x)}).force[0];
    sum += f * dx[i] - damping * dx[i] * dx[i] / T;
    sums.push_back(sum);
    x += dx[i];
  }
  return sums;
}

}  // namespace

TEST_CASE("the coupling pulls the device to the tool: K d + B v, K_a t + B_a w") {
  HapticController c =
      bare({.stiffness = 400, .damping = 3, .angularStiffness = 0.2, .angularDamping = 0.004});
  c.check();
  Wrench w = tick(c, 0, {at(0.01, 0.3)});
  CHECK((w.force - Vector3d(-4, 0, 0)).norm() < 1e-12);  // no speed is known yet
  CHECK((w.torque - Vector3d(0, 0, -0.06)).norm() < 1e-12);
  w = tick(c, T, {at(0.0102, 0.301)});
  CHECK((w.force - Vector3d(-400 * 0.0102 - 3 * 0.2, 0, 0)).norm() < 1e-11);
  CHECK((w.torque - Vector3d(0, 0, -0.2 * 0.301 - 0.004 * 1)).norm() < 1e-11);
  // the tool moves, and is where its velocity says
  ToolState tool;
  tool.velocity << 0.5, 0, 0, 0, 0, 2;
  tool.time = T;
  c.accept(T, tool);
  c.observe(3 * T, {at(0.0102, 0.301)});
  w = c.wrench(3 * T);
  CHECK((w.force - Vector3d(400 * (0.001 - 0.0102) + 3 * 0.5, 0, 0)).norm() < 1e-11);
  CHECK((w.torque - Vector3d(0, 0, 0.2 * (0.004 - 0.301) + 0.004 * 2)).norm() < 1e-11);
  // but not for longer than maxExtrapolation
  c.observe(10, {at(0)});
  c.observe(10.001, {at(0)});
  CHECK(c.wrench(10.001).force[0] == Approx(400 * 0.05 * 0.5 + 3 * 0.5));
}

TEST_CASE("the device's place in the scene, its scale, and that of the force") {
  HapticController c = bare({.stiffness = 100, .damping = 2, .forceCoef = 0.5, .scale = 3});
  c.positionBase = {0, 0, 1};
  c.orientationBase = Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d(0, 0, 1));
  c.check();
  const Wrench w = tick(c, 0, {at(0.01)});
  CHECK((c.reading.pose.center - Vector3d(0, 0.03, 1)).norm() < 1e-15);
  // in the axes of the device: scene force (0, -3, -100) / 2
  CHECK((w.force - Vector3d(-1.5, 0, -50)).norm() < 1e-12);
  // the hand feels the stiffness times scale and forceCoef
  HapticController plain = bare({.damping = 3});
  CHECK(c.stableStiffness() * 1.5 == Approx(plain.stableStiffness()).epsilon(1e-12));
}

TEST_CASE("a velocity filter is a low pass of first order") {
  HapticController c = bare({.stiffness = 0, .damping = 1, .velocityFilter = 0.02});
  double f = 0;
  for (int i = 0; i <= 20; ++i) f = tick(c, i * T, {at(0.1 * i * T)}).force[0];
  CHECK(f == Approx(-0.1 * (1 - std::pow(1 - T / (T + 0.02), 20))).epsilon(1e-10));
}

TEST_CASE("the largest stable stiffness is the closed form without damping of the device") {
  for (const double m : {0.02, 0.05, 1.})
    for (const double b : {0.1, 2., 20.}) {
      const double beta = b * T / (2 * m);
      CHECK(stable_stiffness({m, 0}, b, T) == Approx(2 * b / T * (1 - beta) / (1 + beta)).epsilon(1e-12));
    }
  CHECK(stable_stiffness({0.05, 0}, 0, T) == 0);      // a spring alone never comes to rest
  CHECK(stable_stiffness({0.05, 0}, 100.1, T) == 0);  // B T / 2m > 1
  // series and exponential agree where they meet
  CHECK(stable_stiffness({1, 9.9999999}, 1, T) ==
        Approx(stable_stiffness({1, 10.0000001}, 1, T)).epsilon(3e-8));
  // from the matrix of the recurrence, whose largest eigenvalue passes 1 there
  for (const double b : {0., 0.3, 4., 60.})
    for (const double B : {0., 1., 8.}) {
      const double m = 0.05, K = stable_stiffness({m, b}, B, T);
      if (K == 0) continue;
      const double a = std::max(b, 1e-7) / m, e = std::exp(-a * T), p = -std::expm1(-a * T) / a;
      const double q = a * T < 1e-3 ? T * T / (2 * m) : (T - p) / (a * m), r = p / m;
      auto radius = [&](double k) {
        const double now = -k - B / T, past = B / T;
        Eigen::Matrix3d step;  // of (x, v, x of the tick before)
        step << 1 + q * now, p, q * past, r * now, e, r * past, 1, 0, 0;
        double log = 0;  // of |step^(2^30)|
        for (int i = 0; i < 30; ++i) {
          step = step * step;
          const double size = step.norm();
          log = 2 * log + std::log(size);
          step = step / size;
        }
        return std::exp(log / double(1 << 30));
      };
      INFO(b << " " << B << " " << K);
      CHECK(radius(0.99 * K) < 1);
      CHECK(radius(1.01 * K) > 1);
    }
}

TEST_CASE("within the stable limit the energy of a device that nobody holds goes; beyond it grows") {
  for (const double deviceDamping : {0., 0.5})
    for (const double damping : {0.5, 5.}) {
      HapticController c = bare({.damping = damping, .angularDamping = 1e-3 * damping});
      c.deviceDamping = deviceDamping, c.deviceAngularDamping = 1e-3 * deviceDamping;
      c.deviceInertia = 1e-3 * c.deviceMass;
      const double limit = c.stableStiffness(), angular = c.stableAngularStiffness();
      CHECK(angular == Approx(1e-3 * limit).epsilon(1e-10));
      INFO(deviceDamping << " " << damping << " " << limit);
      c.stiffness = 0.98 * limit, c.angularStiffness = 0.98 * angular;
      c.check();
      // 100 s
      const Energies below = let_go(c, c.deviceMass, deviceDamping, 100'000);
      CHECK(below.late < 1e-6 * below.early);
      c.stiffness = 1.02 * limit;
      const Energies above = let_go(c, c.deviceMass, deviceDamping, 100'000);
      CHECK(above.late > 1e6 * above.early);
      c.stiffness = 0, c.angularStiffness = 1.02 * angular;
      const Energies turning = let_go(c, c.deviceMass, deviceDamping, 100'000);
      CHECK(turning.late > 1e6 * turning.early);
    }
}

TEST_CASE("within the passive limit no hand draws energy from the device; beyond it, one does") {
  HapticController c = bare({.damping = 1});
  c.deviceDamping = 2;
  const double limit = c.passiveStiffness();
  CHECK(limit == Approx(2 * (2 - 1) / T));
  CHECK(c.stableStiffness() > limit);
  // to and fro from tick to tick, the worst that a hand can do (Colgate and Schenkel 1997)
  std::vector<double> worst{0.001};
  for (int i = 0; i < 10'000; ++i) worst.push_back(i % 2 == 0 ? -0.002 : 0.002);
  c.stiffness = 0.999 * limit;
  CHECK(given(c, 2, worst).back() < 0);
  c.stiffness = 1.001 * limit;
  CHECK(given(c, 2, worst).back() > 0);
  // any other, over 100 s: noise, and a walk
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  c.stiffness = limit;
  for (const double memory : {0., 0.9, 0.999}) {
    std::vector<double> dx{1e-4};
    double x = dx[0];
    for (int i = 0; i < 100'000; ++i) {
      dx.push_back(memory * dx.back() + 1e-4 * normal(engine) - 1e-3 * x);
      x += dx.back();
    }
    double maximum = -1;
    for (const double sum : given(c, 2, dx)) maximum = std::max(maximum, sum);
    CHECK(maximum < 0);
  }
}

TEST_CASE("a device in a hand rests where the springs of hand and coupling balance") {
  HandDevice hand{[](double) { return at(0.02, 0.4); }};
  HapticController c = bare();
  c.check();
  for (int i = 0; i < 5000; ++i) hand.write(tick(c, i * T, hand.read(i * T)));
  // k_h (x_t - x) = K x
  CHECK(hand.pose.center[0] == Approx(0.02 * 300 / (300 + 500)).epsilon(1e-9));
  CHECK(Rigid3d::difference({}, hand.pose)[5] == Approx(0.4 * 1 / (1 + 0.5)).epsilon(1e-9));
  CHECK(hand.felt.force[0] == Approx(-500 * hand.pose.center[0]).epsilon(1e-9));
}

TEST_CASE("force and torque are clamped in length, not in direction") {
  HapticController c = bare();
  c.maxForce = 3, c.maxTorque = 0.1;
  DeviceState device;
  device.pose.center = {3, -4, 12};
  device.pose.orientation = Eigen::AngleAxisd(2, Vector3d(0, 0.6, 0.8));
  const Wrench w = tick(c, 0, device);
  CHECK((w.force + 3 * Vector3d(3, -4, 12) / 13).norm() < 1e-12);
  CHECK((w.torque + 0.1 * Vector3d(0, 0.6, 0.8)).norm() < 1e-12);
}

TEST_CASE("the force rises in rampTime, and falls when the simulation has been silent for staleTime") {
  HapticController c;
  c.maxForce = 100;
  c.damping = 0, c.angularDamping = 0;
  c.staleTime = 0.05, c.rampTime = 0.02;
  const DeviceState device{at(0.01)};
  auto at_tick = [&](int i, bool tool) {
    c.observe(i * T, device);
    if (tool) c.accept(i * T, {{}, Rigid3d::Deriv::Zero(), i * T});
    return -c.wrench(i * T).force[0];
  };
  // nothing is known of the tool yet
  for (int i = 0; i < 10; ++i) CHECK(at_tick(i, false) == 0);
  for (int i = 10; i < 100; ++i) CHECK(at_tick(i, true) == Approx(5 * std::min(1., (i - 9) / 20.)));
  // the last state is of tick 99
  for (int i = 100; i < 200; ++i)
    CHECK(at_tick(i, false) == Approx(5 * std::clamp(1 - (i - 149) / 20., 0., 1.)).margin(1e-12));
  // it is back: no jump larger than that of the ramp
  double last = 0, jump = 0;
  for (int i = 200; i < 300; ++i) {
    const double f = at_tick(i, true);
    jump = std::max(jump, std::abs(f - last));
    last = f;
  }
  CHECK(jump == Approx(5 / 20.));
  CHECK(last == Approx(5));
  // the user lets go
  c.activate = false;
  for (int i = 300; i < 330; ++i) last = at_tick(i, true);
  CHECK(last == 0);
  CHECK(c.staleTicks == 10 + 50);
}

TEST_CASE("a tool that is not finite counts as silence, a pose that is not as no force at once") {
  HapticController c;
  c.staleTime = 0.01, c.rampTime = 0.01;
  const DeviceState good{at(0.002)};
  auto run = [&](int from, int to, DeviceState const& device, ToolState const& tool) {
    Vector3d f;
    for (int i = from; i < to; ++i) {
      c.observe(i * T, device);
      c.accept(i * T, tool);
      const Wrench w = c.wrench(i * T);
      f = w.force;
      REQUIRE(f.allFinite());
      REQUIRE(w.torque.allFinite());
    }
    return f;
  };
  CHECK(run(0, 50, good, {})[0] == Approx(-1));
  ToolState bad;
  bad.velocity[4] = one::notANumber;
  CHECK(run(50, 100, good, bad)[0] == 0);
  CHECK(c.badTools == 50);
  CHECK(run(100, 150, good, {})[0] == Approx(-1));
  DeviceState lost = good;
  lost.pose.center[1] = one::notANumber;
  CHECK(run(150, 151, lost, {}).norm() == 0);
  lost = good;
  lost.pose.orientation.coeffs().setZero();
  CHECK(run(151, 152, lost, {}).norm() == 0);
  CHECK(c.badPoses == 2);
  CHECK(c.reading.pose == good.pose);  // what the simulation sees
  // back by the ramp, and the jump of the pose is no velocity
  CHECK(run(152, 153, {at(-0.002)}, {})[0] == Approx(0.1));
}

TEST_CASE("settings are refused that are out of range, or not stable") {
  using H = HapticController;
  auto refused = [](H c, std::initializer_list<std::string_view> words) {
    one::says([&] { c.check("HapticLoop"); }, words);
  };
  refused({.rate = 0}, {"HapticLoop", "rate is 0 Hz", "greater than 0"});
  refused({.rate = -5}, {"rate is -5"});
  refused({.rate = one::notANumber}, {"rate is nan"});
  refused({.rate = 1e7}, {"rate is 10000000", "at most 100000"});
  refused({.stiffness = -1}, {"stiffness is -1 N/m", "at least 0"});
  refused({.maxForce = -1}, {"maxForce is -1"});
  refused({.deviceMass = 0}, {"deviceMass is 0"});
  refused({.orientationBase = {0, 0, 0, 0}}, {"orientationBase"});
  refused({.stiffness = 5000}, {"stiffness is 5000", "1000 Hz", "stable up to 3843", "raise the rate"});
  refused({.rate = 100}, {"stiffness is 500", "100 Hz"});
  refused({.stiffness = 10, .damping = 0}, {"stiffness is 10", "stable up to 0"});
  refused({.angularStiffness = 100}, {"angularStiffness is 100", "angularDamping"});
  H c{.stiffness = 5000, .damping = 4, .forceCoef = 0.5};
  c.check();
}

}  // namespace test_haptic_controller
