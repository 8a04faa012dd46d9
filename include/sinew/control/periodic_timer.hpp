// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>

#if defined(__linux__)
#include <pthread.h>
#include <sys/prctl.h>
#include <time.h>
#endif

namespace sinew {

/// Wakes its thread at absolute deadlines a period apart, so that delays do not add up. Deadlines that have
/// passed by a whole period or more are skipped, not made up for.
class PeriodicTimer {
 public:
  using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC

  explicit PeriodicTimer(std::int64_t periodNanoseconds, Clock::time_point start = Clock::now())
      : period_(periodNanoseconds), next_(start) {}

  struct Wake {
    std::int64_t latency;    // after the deadline that it was to meet [ns]
    std::int64_t missed;  // deadlines that have passed since then
  };
  /// Sleeps to the next deadline; the first one is the start.
  Wake wait() {
    if (Clock::now() < next_) sleepTo(next_);
    const std::int64_t latency = (Clock::now() - next_) / std::chrono::nanoseconds(1);
    const std::int64_t missed = latency / period_.count();
    next_ += (missed + 1) * period_;
    return {latency, missed};
  }

  static void sleepTo(Clock::time_point deadline) {
#if defined(__linux__)
    const auto ns = deadline.time_since_epoch() / std::chrono::nanoseconds(1);
    const timespec until{.tv_sec = time_t(ns / 1'000'000'000), .tv_nsec = long(ns % 1'000'000'000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
#else
    std::this_thread::sleep_until(deadline);
#endif
  }

 private:
  std::chrono::nanoseconds period_;
  Clock::time_point next_;
};

/// Asks the system to run the calling thread before all others, at a priority of 1 to 99 of SCHED_FIFO, and
/// to wake it without slack. Says what was reached; a priority of 0 asks for nothing.
inline std::string request_real_time(int priority) {
#if defined(__linux__)
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (priority <= 0) return "SCHED_OTHER";
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) return "SCHED_FIFO " + std::to_string(priority);
  return std::string("SCHED_OTHER (SCHED_FIFO refused: ") + std::strerror(error) + ")";
#else
  return priority <= 0 ? "default" : "default (no SCHED_FIFO here)";
#endif
}

}  // namespace sinew
