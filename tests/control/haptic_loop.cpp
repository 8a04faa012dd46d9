// SPDX-License-Identifier: BSL-1.0
// What does not depend on how busy the machine is: counts, order, and that the force ends at zero.
#include "one_component.hpp"

#include <sinew/control/haptic_loop.hpp>
#include <sinew/control/scripted_device.hpp>

#include <random>
#include <vector>

namespace test_haptic_loop {

using namespace sinew;
using Eigen::Vector3d;

namespace {

struct Fixed {
  DeviceState operator()(double) const {
    DeviceState state;
    state.pose.center = {0.002, 0, 0};
    state.buttons = 5;
    return state;
  }
};

ScriptedDevice<Fixed> fixed_device() { return {Fixed{}, {{7, 7, 7}, {7, 7, 7}}}; }

/// Fails at its n-th read or write.
struct Failing {
  long failingRead = -1, failingWrite = -1, reads = 0, writes = 0;
  Wrench felt{{7, 7, 7}, {7, 7, 7}};

  DeviceState read(double) {
    if (++reads == failingRead) throw Error("device", "the cable is out; plug it in");
    return Fixed{}(0);
  }
  void write(Wrench const& wrench) {
    if (++writes == failingWrite) throw Error("device", "the motor is hot; let it cool");
    felt = wrench;
  }
};

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
bool zero(Wrench const& w) { return w.force.norm() == 0 && w.torque.norm() == 0; }

}  // namespace

TEST_CASE("a histogram of latencies has its percentiles to an eighth") {
  for (int i = 0; i < LatencyHistogram::buckets; ++i) {
    const double low = LatencyHistogram::bound(i);
    REQUIRE(LatencyHistogram::bucket(std::uint64_t(low)) == i);
    REQUIRE(LatencyHistogram::bucket(std::uint64_t(LatencyHistogram::bound(i + 1)) - 1) == i);
    if (i > 8) REQUIRE(LatencyHistogram::bound(i + 1) <= low * 1.125);
  }
  LatencyHistogram h;
  CHECK(h.percentile(0.999) == 0);
  std::vector<double> all;
  std::mt19937 engine(3);
  std::lognormal_distribution<double> spread(10, 2);
  double sum = 0;
  for (int i = 0; i < 20'000; ++i) {
    all.push_back(std::floor(spread(engine)));
    h.add(std::int64_t(all.back()));
    sum += all.back();
  }
  std::sort(all.begin(), all.end());
  for (const double p : {0.01, 0.5, 0.9, 0.99, 0.999, 1.}) {
    const double exact = all[std::size_t(std::ceil(p * 20'000)) - 1] * 1e-9;
    CHECK(h.percentile(p) >= exact);
    CHECK(h.percentile(p) <= exact * 1.1251);
  }
  CHECK(h.count() == 20'000);
  CHECK(h.worst() == Approx(all.back() * 1e-9));
  CHECK(h.mean() == Approx(sum / 20'000 * 1e-9));
  CHECK(h.between(0, 1e9) == 20'000);
  CHECK(h.between(0, 1024e-9) + h.between(1024e-9, 1e9) == 20'000);
  CHECK(h.between(0, 1024e-9) == std::lower_bound(all.begin(), all.end(), 1024) - all.begin());
  // what is out of bounds counts too
  h.add(-5);
  h.add(std::int64_t(1) << 50);
  CHECK(h.count() == 20'002);
  CHECK(h.between(0, 1e9) == 20'002);
}

TEST_CASE("a timer wakes at absolute deadlines, never early, and counts those it skipped") {
  using Clock = PeriodicTimer::Clock;
  const auto start = Clock::now() + std::chrono::milliseconds(2);
  PeriodicTimer timer(1'000'000, start);
  long deadline = -1;
  for (int i = 0; i < 100; ++i) {
    if (i == 50) sleep(0.0105);  // ten deadlines pass
    const auto [latency, missed] = timer.wait();
    const auto now = Clock::now();
    ++deadline;
    REQUIRE(latency >= 0);
    REQUIRE(latency / 1'000'000 == missed);
    REQUIRE(now >= start + std::chrono::milliseconds(deadline) + std::chrono::nanoseconds(latency));
    if (i == 50) CHECK(missed >= 9);
    deadline += missed;
  }
}

TEST_CASE("a loop reads, couples and writes at its rate, and ends with a force of zero") {
  auto device = fixed_device();
  HapticController settings;
  settings.rampTime = 0.02, settings.staleTime = 5;
  HapticLoop loop(device, settings);
  CHECK(!loop.running());
  for (int again = 0; again < 2; ++again) {
    loop.start();
    CHECK(loop.running());
    CHECK(loop.target().pose.center == Vector3d(0.002, 0, 0));
    one::says([&] { loop.start(); }, {"HapticLoop", "is running already"});
    one::says([&] { (void)loop.statistics(); }, {"after stop()"});
    long steps = 0;
    double time = 0;
    loop.run(0.3, 0.01, [&](ToolTarget const& target) {
      ++steps;
      CHECK(target.pose.center == Vector3d(0.002, 0, 0));  // it stands still
      CHECK(target.buttons == 5);
      CHECK(target.time > time);
      time = target.time;
      return ToolState{};
    });
    CHECK(steps == 30);
    CHECK(loop.time() >= 0.29);
    loop.stop();
    loop.stop();
    CHECK(!loop.running());
    CHECK(zero(device.felt));
    const HapticStatistics s = loop.statistics();
    CHECK(s.ticks > 1);
    CHECK(double(s.ticks + s.missed - 1) == Approx(s.elapsed / 1e-3).margin(1.001));
    CHECK(s.wakeLatency.count() == s.ticks);
    CHECK(s.work.count() == s.ticks);
    CHECK(s.step.count() == 30);
    CHECK(s.rate() <= 1001);
    CHECK(s.largestForce <= 1.0000001);  // K d
    if (s.ticks > 60) {
      CHECK(s.largestForce == Approx(1));
      CHECK(s.largestJump == Approx(0.05));  // of the ramp
    }
    CHECK(s.badPoses + s.badTools == 0);
    CHECK(s.scheduling.substr(0, 6) == "SCHED_");
  }
}

TEST_CASE("an exception of the simulation stops the loop with a force of zero, and goes on") {
  auto device = fixed_device();
  HapticLoop loop(device);
  loop.start();
  int steps = 0;
  one::says(
      [&] {
        loop.run(10, 0.005, [&](ToolTarget const&) {
          if (++steps == 20) throw Error("step 20", "the simulation diverged");
          return ToolState{};
        });
      },
      {"step 20", "diverged"});
  CHECK(steps == 20);
  CHECK(!loop.running());
  CHECK(zero(device.felt));
}

TEST_CASE("an exception of the device ends the loop with a force of zero; the simulation hears of it") {
  for (const bool writing : {false, true}) {
    Failing device;
    (writing ? device.failingWrite : device.failingRead) = 40;
    HapticLoop loop(device);
    loop.start();
    one::says([&] { loop.run(10, 0.005, [](ToolTarget const&) { return ToolState{}; }); },
              {writing ? "the motor is hot" : "the cable is out"});
    CHECK(!loop.running());
    CHECK(zero(device.felt));
    loop.stop();  // it has been said
  }
  // at the first read already
  Failing device;
  device.failingRead = 1;
  HapticLoop loop(device);
  one::says([&] { loop.start(); }, {"the cable is out"});
  CHECK(!loop.running());
  // a simulation with a pace of its own asks, or stops
  Failing other;
  other.failingRead = 5;
  HapticLoop paced(other);
  paced.start();
  for (int i = 0; i < 2000 && paced.running(); ++i) sleep(0.005);
  CHECK(!paced.running());
  one::says([&] { paced.check(); }, {"the cable is out"});
  paced.check();
}

TEST_CASE("a loop that goes out of scope ends with a force of zero") {
  auto device = fixed_device();
  {
    HapticLoop loop(device);
    loop.start();
    loop.publish({});
    sleep(0.05);
  }
  CHECK(zero(device.felt));
}

TEST_CASE("while the simulation hangs, the force goes to zero") {
  struct Watched : ScriptedDevice<Fixed> {
    std::atomic<double> force{-1};
    Watched() : ScriptedDevice<Fixed>{Fixed{}} {}
    void write(Wrench const& wrench) { force = wrench.force.norm(); }
  } device;
  HapticController settings;
  settings.staleTime = 0.02, settings.rampTime = 0.02;
  HapticLoop loop(device, settings);
  loop.start();
  double maximum = 0;
  loop.run(0.2, 0.005, [&](ToolTarget const&) {
    maximum = std::max(maximum, device.force.load());
    return ToolState{};
  });
  CHECK(maximum > 0);
  // silent for up to 10 s
  for (int i = 0; i < 2000 && device.force != 0; ++i) sleep(0.005);
  CHECK(device.force == 0);
  CHECK(loop.running());
  loop.stop();
  CHECK(loop.statistics().staleTicks > 0);
}

TEST_CASE("a loop refuses bad settings") {
  auto device = fixed_device();
  auto refused =
      [&](HapticController const& settings, int priority, std::initializer_list<std::string_view> words) {
        one::says([&] { HapticLoop loop(device, settings, priority); }, words);
      };
  refused({.rate = 0}, 0, {"HapticLoop: HapticController: rate is 0"});
  refused({.stiffness = 1e6}, 0, {"stable up to"});
  refused({}, 100, {"priority is 100"});
  refused({}, -1, {"priority is -1"});
  HapticLoop loop(device, {}, 0);
  auto step = [](ToolTarget const&) { return ToolState{}; };
  one::says([&] { loop.run(1, 0.01, step); }, {"HapticLoop::run", "not running"});
  one::says([&] { loop.run(1, 0, step); }, {"dt is 0 s"});
  one::says([&] { loop.run(one::notANumber, 0.01, step); }, {"finite"});
  loop.start();
  loop.stop();
  CHECK(loop.statistics().scheduling == "SCHED_OTHER");
  ScriptedDevice lost{[](double) {
    DeviceState state;
    state.pose.center[0] = one::notANumber;
    return state;
  }};
  HapticLoop none(lost);
  one::says([&] { none.start(); }, {"first pose", "not finite"});
}

}  // namespace test_haptic_loop
