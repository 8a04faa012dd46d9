// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/haptic_controller.hpp>
#include <sinew/control/latency_histogram.hpp>
#include <sinew/control/periodic_timer.hpp>
#include <sinew/control/triple_buffer.hpp>

#include <atomic>
#include <exception>
#include <thread>

namespace sinew {

/// How well a haptic loop kept its time.
struct HapticStatistics {
  long ticks = 0, missed = 0;                       // deadlines that were met, and that passed without a tick
  double elapsed = 0;                               // s, from the first tick to the last
  LatencyHistogram wakeLatency{};                   // of the wake after its deadline
  LatencyHistogram work{};                          // of a tick
  LatencyHistogram step{};                          // of the simulation, in run()
  long lateSteps = 0;                               // of those, longer than dt
  double largestForce = 0;                          // N
  double largestJump = 0;                           // N, of the force between one tick and the next
  double largestTorque = 0, largestTorqueJump = 0;  // N m
  long staleTicks = 0, badPoses = 0, badTools = 0;
  std::string scheduling{};

  double rate() const { return elapsed > 0 ? double(ticks - 1) / elapsed : 0; }
};

/// A thread that reads a device, couples it to the simulated tool and writes the force, at a fixed high rate;
/// the simulation goes on in a thread of its own, at its own pace. They exchange their latest states and
/// never wait for each other.
///   HapticLoop loop(device, {.stiffness = 800});
///   loop.start();
///   loop.run(60, 0.01, [&](ToolTarget const& target) {   // 60 s, in steps of 0.01 s
///     coupling.setTarget(target.pose, target.velocity);     // a VirtualCoupling in the scene
///     sim.animate(0.01);
///     return ToolState{tool.position[0], tool.velocity[0]};
///   });
///   loop.stop();
/// The device is given a force of zero when the loop ends: by stop(), by the destructor, by an exception of
/// the step, or of the device, which run(), check() and stop() throw on. Functions but those marked are for
/// the thread that made the loop.
template <HapticDevice Device>
class HapticLoop {
 public:
  /// Throws Error where the controller's check() does, and where the priority is not 0 to 99.
  explicit HapticLoop(Device& device, HapticController const& controller = {}, int priority = 80)
      : device_(device), controller_(controller), priority_(priority) {
    controller_.check("HapticLoop");
    if (priority < 0 || priority > 99)
      throw Error("HapticLoop",
                  text("priority is ", priority, ", but must be 1 to 99, or 0 for an ordinary thread"));
  }
  HapticLoop(HapticLoop const&) = delete;
  HapticLoop& operator=(HapticLoop const&) = delete;
  ~HapticLoop() { end(); }

  void start() {
    if (thread_.joinable()) throw Error("HapticLoop", "the loop is running already; call stop() first");
    controller_.restart();
    tools_.update();  // what is left of the last run
    steps_ = {};
    lateSteps_ = 0;
    // one pose is there before the simulation asks
    epoch_ = Clock::now();
    controller_.observe(0, device_.read(0));
    if (!controller_.hasReading)
      throw Error("HapticLoop", "the first pose of the device is not finite; check the device");
    targets_.write(controller_.reading);
    targets_.update();
    statistics_ = {};
    failure_ = nullptr;
    quit_.store(false, std::memory_order_relaxed);
    failed_.store(false, std::memory_order_relaxed);
    thread_ = std::thread([this] { loop(); });
  }

  /// Ends the thread; the device has a force of zero. Throws what the device threw.
  void stop() {
    end();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }
  bool running() const { return thread_.joinable() && !failed_.load(std::memory_order_acquire); }
  /// Throws what the device threw, if it did.
  void check() {
    if (failed_.load(std::memory_order_acquire)) stop();
  }

  /// Seconds since start(). From any thread.
  double time() const { return std::chrono::duration<double>(Clock::now() - epoch_).count(); }
  /// By the simulation's thread: where the tool should be, as the loop saw it last.
  ToolTarget const& target() {
    targets_.update();
    return targets_.read();
  }
  /// By the simulation's thread: where the tool is.
  void publish(ToolState const& tool) { tools_.write(tool); }

  /// The simulation, at its pace: every dt [s], step(target) with where the target will be at the end of the
  /// step, which returns the ToolState then; its time need not be set. A step that takes longer than dt
  /// delays the next. Where step throws, the loop is stopped, with a force of zero, and the exception goes
  /// on.
  template <class Step>
  void run(double seconds, double dt, Step&& step) {
    if (!(dt > 0) || !std::isfinite(dt) || !(seconds >= 0) || !(seconds / dt < 1e12))
      throw Error("HapticLoop::run",
                  text("dt is ", dt, " s of ", seconds, " s, but must be finite and greater than 0"));
    if (!thread_.joinable()) throw Error("HapticLoop::run", "the loop is not running; call start() first");
    try {
      const auto length = std::chrono::nanoseconds(std::llround(dt * 1e9));
      Clock::time_point begin = Clock::now();
      for (long i = 0; i < std::llround(seconds / dt); ++i) {
        PeriodicTimer::sleepTo(begin);
        check();
        const Clock::time_point before = Clock::now();
        const double end = time() + dt;
        ToolTarget const& now = target();
        ToolState tool = step(now.ahead(end - now.time));
        tool.time = end;
        publish(tool);
        const Clock::time_point after = Clock::now();
        steps_.add((after - before) / std::chrono::nanoseconds(1));
        lateSteps_ += after - before > length;
        begin = std::max(begin + length, after);
      }
      check();
    } catch (...) {
      end();
      throw;
    }
  }

  /// Of the last run; only while the loop is stopped.
  HapticStatistics statistics() const {
    if (thread_.joinable()) throw Error("HapticLoop", "statistics are there after stop()");
    HapticStatistics all = statistics_;
    all.step = steps_;
    all.lateSteps = lateSteps_;
    all.staleTicks = controller_.staleTicks;
    all.badPoses = controller_.badPoses;
    all.badTools = controller_.badTools;
    return all;
  }
  /// Its settings at any time; what it keeps from tick to tick only while the loop is stopped.
  HapticController const& controller() const { return controller_; }

 private:
  using Clock = PeriodicTimer::Clock;

  Device& device_;
  HapticController controller_;
  int priority_;
  TripleBuffer<ToolTarget> targets_{};
  TripleBuffer<ToolState> tools_{};
  Clock::time_point epoch_{};
  std::atomic<bool> quit_{false}, failed_{false};
  std::exception_ptr failure_{};
  HapticStatistics statistics_{};
  LatencyHistogram steps_{};
  long lateSteps_ = 0;
  std::thread thread_{};

  void end() {
    if (!thread_.joinable()) return;
    quit_.store(true, std::memory_order_relaxed);
    thread_.join();
  }

  void loop() {
    try {
      statistics_.scheduling = request_real_time(priority_);
      ticks();
    } catch (...) {
      failure_ = std::current_exception();
    }
    try {
      device_.write(Wrench{});
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
    }
    if (failure_) failed_.store(true, std::memory_order_release);
  }

  void ticks() {
    HapticStatistics& s = statistics_;
    const std::int64_t period = std::llround(1e9 / controller_.rate);
    const Clock::time_point begin = Clock::now() + std::chrono::nanoseconds(period);
    PeriodicTimer timer(period, begin);
    Wrench last{};
    while (!quit_.load(std::memory_order_relaxed)) {
      const auto [latency, missed] = timer.wait();
      const Clock::time_point woken = Clock::now();
      const double now = std::chrono::duration<double>(woken - epoch_).count();
      controller_.observe(now, device_.read(now));
      if (controller_.hasReading) targets_.write(controller_.reading);
      if (tools_.update()) controller_.accept(now, tools_.read());
      const Wrench wrench = controller_.wrench(now);
      device_.write(wrench);

      ++s.ticks;
      s.missed += long(missed);
      s.wakeLatency.add(latency);
      s.largestForce = std::max(s.largestForce, wrench.force.norm());
      s.largestJump = std::max(s.largestJump, (wrench.force - last.force).norm());
      s.largestTorque = std::max(s.largestTorque, wrench.torque.norm());
      s.largestTorqueJump = std::max(s.largestTorqueJump, (wrench.torque - last.torque).norm());
      last = wrench;
      s.elapsed = std::chrono::duration<double>(woken - begin).count();
      s.work.add((Clock::now() - woken) / std::chrono::nanoseconds(1));
    }
  }
};

}  // namespace sinew
