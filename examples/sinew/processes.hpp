// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// Functions that run in processes of their own: one that crashes, or is killed, ends nothing but itself.
/// They are killed where this object ends, and where this process is killed. This process has no other
/// threads.
class Processes {
 public:
  /// What has become of one of them.
  struct Ended {
    std::size_t job;
    std::optional<std::string> said;  // what the function returned; nothing where it did not
    std::string error{};              // why, then
  };

  /// Ends those that take longer [s]; 0: none.
  explicit Processes(double timeLimit = 0) : limit_(timeLimit) {}
  Processes(Processes const&) = delete;
  Processes& operator=(Processes const&) = delete;
  ~Processes() { kill(); }

  std::size_t size() const { return running_.size(); }
  /// Throws Failure where there can be no more processes.
  void start(std::size_t job, std::function<std::string()> const& f);
  /// Waits for one to end; nothing where Ctrl-C was pressed (was_interrupted()), and where there is something
  /// to be read from this file.
  std::optional<Ended> wait(int alsoFrom = -1);
  void kill();

 private:
  using Clock = std::chrono::steady_clock;
  struct Process {
    std::size_t job;
    pid_t id;
    int from;  // the end of the pipe from which it is read
    std::string said;
    Clock::time_point end;
  };
  double limit_;
  std::vector<Process> running_{};

  bool readFrom(Process& process);
  Ended reap(std::size_t at, bool tookTooLong);
};

}  // namespace cli
