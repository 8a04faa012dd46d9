// SPDX-License-Identifier: BSL-1.0
// The program sinew, started once for many scenes: with sanitizers its start takes longer than most scenes.
// Given arguments it is sinew. Without, it reads a line a scene, apart by tabs: a folder, and the arguments;
// runs sinew there, with what it says in the files `out` and `err`; and answers with a line: "exit N", or
// "signal N" where it has crashed, or "hang" where it has taken SINEW_SERVER_SECONDS of the processor (20).
// SINEW_SERVER_SCENES are run by one process (20), which then looks for leaks; where it finds one, the last
// of them answers "leak".
#include "sinew/options.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SINEW_LOOKS_FOR_LEAKS
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(SINEW_LOOKS_FOR_LEAKS)
#include <sanitizer/lsan_interface.h>
#else
static int __lsan_do_recoverable_leak_check() { return 0; }
#endif

namespace {

constexpr int allRun = 76, noMoreScenes = 77, notRun = 98;  // exit statuses of the process that runs scenes

std::vector<std::string> words_of(std::string const& line) {
  std::vector<std::string> words(1);
  for (const char c : line)
    if (c == '\t')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

[[noreturn]] void give_up(char const* what) {
  std::perror(what);
  _exit(notRun);
}
void redirect(int stream, char const* path) {
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0 || dup2(file, stream) < 0) give_up(path);
  close(file);
}

int run(std::vector<std::string> words) {
  if (chdir(words[0].c_str()) != 0) give_up(words[0].c_str());
  redirect(1, "out");
  redirect(2, "err");
  std::array<char, 6> name{"sinew"};
  std::vector<char*> arguments{name.data()};
  for (std::size_t i = 1; i < words.size(); ++i) arguments.push_back(words[i].data());
  const int count = int(arguments.size());
  arguments.push_back(nullptr);
  const int status = cli::program(count, arguments.data());
  std::fflush(stdout);
  std::cout.flush();
  return status;
}

int number_in(char const* variable, int otherwise) {
  char const* const given = std::getenv(variable);
  return given ? std::max(std::atoi(given), 1) : otherwise;
}

/// Ends the process by SIGXCPU when it has taken the processor for so much longer.
void limit_processor(int seconds) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const rlim_t until = rlim_t(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 + seconds);
  const rlimit limit{until, RLIM_INFINITY};
  if (setrlimit(RLIMIT_CPU, &limit) != 0) give_up("setrlimit");
}

[[noreturn]] void run_some(int scenes, int seconds, int answers) {
  std::string line;
  for (int i = 1; i <= scenes; ++i) {
    if (!std::getline(std::cin, line)) _exit(noMoreScenes);
    limit_processor(seconds);
    const int status = run(words_of(line));
    const bool leaks = i == scenes && __lsan_do_recoverable_leak_check() != 0;
    dprintf(answers, leaks ? "leak\n" : "exit %d\n", status);
  }
  _exit(allRun);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) return cli::program(argc, argv);
  prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);  // processes that are copied would copy huge pages
  const int scenes = number_in("SINEW_SERVER_SCENES", 20), seconds = number_in("SINEW_SERVER_SECONDS", 20),
            answers = dup(1);
  for (;;) {
    const pid_t child = fork();
    if (child < 0) give_up("fork");
    if (child == 0) run_some(scenes, seconds, answers);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
      dprintf(answers, "hang\n");
    else if (WIFSIGNALED(status))
      dprintf(answers, "signal %d\n", WTERMSIG(status));
    else if (WEXITSTATUS(status) == noMoreScenes)
      return 0;
    else if (WEXITSTATUS(status) != allRun)
      dprintf(answers, "exit %d\n", WEXITSTATUS(status));
  }
}
