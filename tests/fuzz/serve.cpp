// SPDX-License-Identifier: BSL-1.0
// The program sinew, started once for many scenes: with sanitizers its start takes longer than most scenes.
// Given arguments it is sinew. Without, it reads a line a scene, apart by tabs: the seconds that it may take,
// a folder, and the arguments; runs sinew in a process of its own there, with what it says in the files `out`
// and `err`; and answers with a line: "exit N", "signal N" or "hang".
#include "sinew/options.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

namespace {

std::vector<std::string> words_of(std::string const& line) {
  std::vector<std::string> words(1);
  for (const char c : line)
    if (c == '\t')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

void redirect(int stream, char const* path, int flags) {
  const int file = open(path, flags, 0666);
  if (file < 0 || dup2(file, stream) < 0) {
    std::perror(path);
    std::exit(98);
  }
  close(file);
}

[[noreturn]] void run(std::vector<std::string>& words) {
  if (chdir(words[1].c_str()) != 0) {
    std::perror(words[1].c_str());
    std::exit(98);
  }
  redirect(0, "/dev/null", O_RDONLY);
  redirect(1, "out", O_WRONLY | O_CREAT | O_TRUNC);
  redirect(2, "err", O_WRONLY | O_CREAT | O_TRUNC);
  std::array<char, 6> name{"sinew"};
  std::vector<char*> arguments{name.data()};
  for (std::size_t i = 2; i < words.size(); ++i) arguments.push_back(words[i].data());
  const int count = int(arguments.size());
  arguments.push_back(nullptr);
  std::exit(cli::program(count, arguments.data()));
}

void answer(pid_t child, double seconds, sigset_t const& ends) {
  const timespec limit{time_t(seconds), long((seconds - double(time_t(seconds))) * 1e9)};
  int signal = 0, status = 0;
  do signal = sigtimedwait(&ends, nullptr, &limit);
  while (signal < 0 && errno == EINTR);
  if (signal < 0) kill(child, SIGKILL);
  waitpid(child, &status, 0);
  if (signal < 0)
    std::cout << "hang";
  else if (WIFSIGNALED(status))
    std::cout << "signal " << WTERMSIG(status);
  else
    std::cout << "exit " << WEXITSTATUS(status);
  std::cout << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) return cli::program(argc, argv);
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGCHLD);
  sigprocmask(SIG_BLOCK, &ends, nullptr);
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<std::string> words = words_of(line);
    const double seconds = std::atof(words[0].c_str());
    if (words.size() < 3 || !(seconds > 0)) {
      std::cerr << "serve: a line has seconds, a folder and arguments, apart by tabs\n";
      return 1;
    }
    const pid_t child = fork();
    if (child < 0) {
      std::perror("serve: fork");
      return 1;
    }
    if (child == 0) {
      sigprocmask(SIG_UNBLOCK, &ends, nullptr);
      run(words);
    }
    answer(child, seconds, ends);
  }
}
