// SPDX-License-Identifier: BSL-1.0
#include "processes.hpp"

#include "scene.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace cli {

using sinew::text;

namespace {

[[noreturn]] void run_here(int to, pid_t parent, std::function<std::string()> const& f) {
  // Ctrl-C goes to all processes of a terminal; the one above decides
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (::getppid() != parent) _exit(1);
  const std::string said = f();
  for (std::string_view rest = said; !rest.empty();) {
    const ssize_t n = ::write(to, rest.data(), rest.size());
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) rest.remove_prefix(std::size_t(n));
  }
  _exit(0);  // destructors would only give memory back
}

}  // namespace

void Processes::start(std::size_t job, std::function<std::string()> const& f) {
  int ends[2];
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const bool piped = ::pipe(ends) == 0;
  const pid_t id = piped ? ::fork() : -1;
  if (id < 0) {
    const int cause = errno;
    if (piped) ::close(ends[0]), ::close(ends[1]);
    throw Failure{badScene,
                  {text("no process can be started for a run: ",
                        static_cast<char const*>(std::strerror(cause)),
                        "; give fewer --jobs")}};
  }
  if (id == 0) {
    ::close(ends[0]);
    for (Process const& other : running_) ::close(other.from);
    try {
      run_here(ends[1], parent, f);
    } catch (...) {
      _exit(1);
    }
  }
  ::close(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  const auto end =
      limit_ > 0
          ? Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_))
          : Clock::time_point::max();
  running_.push_back({job, id, ends[0], {}, end});
}

std::optional<Processes::Ended> Processes::wait(int alsoFrom) {
  while (!was_interrupted() && (!running_.empty() || alsoFrom >= 0)) {
    std::vector<pollfd> pipes;
    for (Process const& p : running_) pipes.push_back({p.from, POLLIN, 0});
    pipes.push_back({alsoFrom, POLLIN, 0});  // none where it is negative
    // a signal that comes just before poll is seen at the next look
    const int ready = ::poll(pipes.data(), nfds_t(pipes.size()), 100);
    const auto now = Clock::now();
    for (std::size_t i = 0; i < running_.size(); ++i) {
      const bool late = now > running_[i].end;
      const bool ended = ready > 0 && pipes[i].revents != 0 && !readFrom(running_[i]);
      if (ended || late) return reap(i, late && !ended);
    }
    if (ready > 0 && pipes.back().revents != 0) return {};
  }
  return {};
}

// false where there will be no more
bool Processes::readFrom(Process& process) {
  char bytes[4096];
  for (;;) {
    const ssize_t n = ::read(process.from, bytes, sizeof bytes);
    if (n == 0) return false;
    if (n > 0)
      process.said.append(bytes, std::size_t(n));
    else if (errno != EINTR)
      return errno == EAGAIN || errno == EWOULDBLOCK;
  }
}

Processes::Ended Processes::reap(std::size_t at, bool tookTooLong) {
  Process process = std::move(running_[at]);
  running_.erase(running_.begin() + std::ptrdiff_t(at));
  ::close(process.from);
  if (tookTooLong) ::kill(process.id, SIGKILL);
  int status = 0;
  while (::waitpid(process.id, &status, 0) < 0 && errno == EINTR) {
  }
  Ended ended{process.job, {}};
  if (tookTooLong) {
    ended.error = text("the run took more than the ", limit_, " s of --time-limit, and was ended");
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    ended.said = std::move(process.said);
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    ended.error =
        text("the process of the run was ended by signal ",
             signal,
             " (",
             static_cast<char const*>(::strsignal(signal)),
             signal == SIGKILL ? "), by somebody or for want of memory; fewer --jobs need less" : ")");
  } else {
    ended.error = text("the process of the run ended before it was done, with status ", WEXITSTATUS(status));
  }
  return ended;
}

void Processes::kill() {
  for (Process const& p : running_) {
    ::kill(p.id, SIGKILL);
    while (::waitpid(p.id, nullptr, 0) < 0 && errno == EINTR) {
    }
    ::close(p.from);
  }
  running_.clear();
}

}  // namespace cli
