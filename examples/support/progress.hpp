// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <unistd.h>
#include <chrono>
#include <cstdio>

namespace examples {

/// A bar on the terminal, and what it took. Quiet where standard error is no terminal.
class Progress {
 public:
  explicit Progress(long steps) : steps_(steps), shown_(isatty(2) != 0) {}

  void at(long step) {
    const int percent = int(100 * step / steps_);
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    char bar[51] = "..................................................";
    for (int i = 0; i < percent / 2; ++i) bar[i] = '#';
    std::fprintf(stderr, "\r[%s] %3d %%%s", bar, percent, step == steps_ ? "\n" : "");
  }

 private:
  long steps_;
  int percent_ = -1;
  bool shown_;
};

/// Seconds of wall time spent between start() and stop(), summed.
class Stopwatch {
 public:
  void start() { since_ = Clock::now(); }
  void stop() { seconds_ += std::chrono::duration<double>(Clock::now() - since_).count(); }
  double seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point since_{};
  double seconds_ = 0;
};

}  // namespace examples
