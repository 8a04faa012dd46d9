// SPDX-License-Identifier: BSL-1.0
#include "sinew_mpi/commands.hpp"

#include "sinew/sweep_summary.hpp"
#include "sinew/sweep_table.hpp"
#include "support/progress.hpp"

#include <sinew/io/text_reader.hpp>
#include <sinew/mpi/communicator.hpp>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>

extern char** environ;

namespace cli {

using namespace sinew;

namespace {

std::string cause() { return static_cast<char const*>(std::strerror(errno)); }

// The program sinew, which does the runs of this rank: it knows all components, and gives each run a process
// of its own.
class Worker {
 public:
  Worker(char** argv, int rank, int beside) {
    int told[2], says[2];
    if (::pipe2(told, O_CLOEXEC) != 0 || ::pipe2(says, O_CLOEXEC) != 0)
      throw Error("", text("no pipe to the runs: ", cause()));
    to_ = told[1], from_ = says[0];
    ::fcntl(from_, F_SETFL, O_NONBLOCK);
    std::vector<std::string> words(argv, argv + count(argv));
    for (std::string const& word :
         {std::string("--worker"), std::to_string(rank), std::string("--beside"), std::to_string(beside)})
      words.push_back(word);
    std::vector<char*> list;
    for (auto& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, told[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, says[1], STDOUT_FILENO);
    const std::string program = path();
    const int failed = ::posix_spawnp(&id_, program.c_str(), &files, nullptr, list.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(told[0]), ::close(says[1]);
    if (failed) {
      id_ = -1;
      throw Error("",
                  text("the program ",
                       program,
                       ", which does the runs, cannot be started: ",
                       static_cast<char const*>(std::strerror(failed)),
                       "; install it beside sinew-mpi on all machines"));
    }
  }
  Worker(Worker const&) = delete;
  Worker& operator=(Worker const&) = delete;
  ~Worker() {
    ::close(to_), ::close(from_);  // at the end of its input it ends its runs and itself
    if (id_ > 0) ::waitpid(id_, nullptr, 0);
  }

  void start(std::size_t run) {
    const std::string line = text(run, '\n');
    // the pipe has room for some thousand numbers
    if (::write(to_, line.data(), line.size()) != ssize_t(line.size())) throw ended();
  }
  /// Waits a little for something to read. Throws Error where the program has ended.
  void listen(int milliseconds) {
    pollfd end{from_, POLLIN, 0};
    if (::poll(&end, 1, milliseconds) <= 0) return;
    char bytes[65536];
    for (;;) {
      const ssize_t n = ::read(from_, bytes, sizeof bytes);
      if (n > 0)
        said_.append(bytes, std::size_t(n));
      else if (n == 0 && said_.find('\n') != said_.npos)
        return;  // what it has said last comes first
      else if (n == 0)
        throw ended();
      else if (errno != EINTR)
        return;
    }
  }
  /// What it has said, line by line.
  std::optional<std::string> line() {
    const std::size_t end = said_.find('\n');
    if (end == said_.npos) return {};
    std::string first = said_.substr(0, end);
    said_.erase(0, end + 1);
    return first;
  }

 private:
  pid_t id_ = -1;
  int to_ = -1, from_ = -1;
  std::string said_{};

  static std::size_t count(char** argv) {
    std::size_t n = 0;
    while (argv[n]) ++n;
    return n;
  }
  static std::string path() {
    std::string self(4096, '\0');
    const auto length = ::readlink("/proc/self/exe", self.data(), self.size());
    self.resize(length > 0 ? std::size_t(length) : 0);
    self.resize(self.rfind('/') + 1);
    self += "sinew";
    return ::access(self.c_str(), X_OK) == 0 ? self : "sinew";
  }
  Error ended() {
    int status = 0;
    const bool known = id_ > 0 && ::waitpid(id_, &status, 0) == id_;
    id_ = -1;
    std::string how = "has ended";
    if (known && WIFSIGNALED(status))
      how = text("was ended by signal ",
                 WTERMSIG(status),
                 " (",
                 static_cast<char const*>(::strsignal(WTERMSIG(status))),
                 ')');
    return Error(
        "",
        text("the program sinew, which did the runs here, ",
             how,
             "; the runs that had ended are in the table, and the same command goes on with the others"));
  }
};

// what the sweep is, as the program on a rank has read it
struct Known {
  std::string output{};
  SweepHeader header{};
};

std::string machine() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return static_cast<char const*>(name);
}

Known greeting(Worker& worker, mpi::Communicator& ranks, int& status) {
  std::vector<std::string> lines;
  std::size_t expected = 1;
  while (lines.size() < expected) {
    worker.listen(20);
    ranks.look("the scene of a sweep");
    while (lines.size() < expected)
      if (auto line = worker.line()) {
        lines.push_back(std::move(*line));
        if (lines.size() > 1) continue;
        const std::size_t blank = lines[0].find(' ');
        std::size_t more = 0;
        if (blank == std::string::npos || !io::parse_number(lines[0].substr(0, blank), status) ||
            !io::parse_number(lines[0].substr(blank + 1), more))
          throw Error("", "the program sinew beside sinew-mpi is of another version; install both together");
        expected += more;
      } else {
        break;
      }
  }
  if (status != ok) {
    std::string all;
    for (std::size_t i = 1; i < lines.size(); ++i) all += text(i > 1 ? "\n" : "", lines[i]);
    throw Error("", all);
  }
  return {lines[1], read_sweep(lines[1], text(lines[2], '\n', lines[3], '\n')).header};
}

// all ranks have the same scene, and the same program
void compare(Known const& known, mpi::Communicator& ranks) {
  std::string const own = known.header.text();
  std::vector<char> first(own.begin(), own.end());
  ranks.broadcast(first, "the sweep of rank 0");
  if (own != std::string(first.begin(), first.end()))
    throw Error("",
                text("on ",
                     machine(),
                     " the scene file, its data or the version of sinew is another than on rank 0; give all "
                     "machines the same"));
}

constexpr int ofRun = 11, ofLine = 12;  // tags of messages: from rank 0, and to it
constexpr long noMore = -1;

// A rank but the first one: does what it is told.
void follow(Worker& worker, mpi::Communicator& ranks) {
  for (;;) {
    worker.listen(5);
    while (auto line = worker.line()) {
      auto message = std::make_unique<std::string>(std::move(*line));
      MPI_Request request = ranks.send(0, message->data(), message->size(), ofLine);
      try {
        ranks.wait({&request, 1}, "rank 0, which takes a line of the table");
      } catch (...) {
        mpi::keep(std::move(message));
        throw;
      }
    }
    ranks.look("runs of the sweep, from rank 0");
    for (;;) {
      int come = 0;
      MPI_Iprobe(0, ofRun, ranks.handle(), &come, MPI_STATUS_IGNORE);
      if (!come) break;
      long run = noMore;
      MPI_Recv(&run, 1, MPI_LONG, 0, ofRun, ranks.handle(), MPI_STATUS_IGNORE);
      if (run == noMore) return;
      worker.start(std::size_t(run));
    }
  }
}

// Rank 0: gives each rank runs as it has ended others, and writes the table.
class Leader {
 public:
  Leader(SweepOptions const& options, Worker& worker, mpi::Communicator& ranks, SweepTable& table,
         std::deque<std::size_t> missing, SweepSummary& summary)
      : worker_(worker),
        ranks_(ranks),
        table_(table),
        missing_(std::move(missing)),
        summary_(summary),
        progress_(long(std::max<std::size_t>(summary.part(), 1))),
        words_(options.output == Output::words) {}

  void run(int jobs) {
    examples::Stopwatch clock;
    clock.start();
    // one of each rank first, then the second ones
    for (int k = 0; k < jobs; ++k)
      for (int r = 0; r < ranks_.size(); ++r) give(r);
    while (running_ > 0) {
      worker_.listen(2);
      while (auto line = worker_.line()) take(0, std::move(*line));
      ranks_.look("the runs of a sweep");
      for (;;) {
        int come = 0, bytes = 0;
        MPI_Status from;
        MPI_Iprobe(MPI_ANY_SOURCE, ofLine, ranks_.handle(), &come, &from);
        if (!come) break;
        MPI_Get_count(&from, MPI_BYTE, &bytes);
        std::string line(std::size_t(bytes), '\0');
        MPI_Recv(line.data(), bytes, MPI_BYTE, from.MPI_SOURCE, ofLine, ranks_.handle(), MPI_STATUS_IGNORE);
        take(from.MPI_SOURCE, std::move(line));
      }
    }
    for (int r = 1; r < ranks_.size(); ++r) tell(r, noMore);
    clock.stop();
    summary_.seconds = clock.seconds();
  }

 private:
  Worker& worker_;
  mpi::Communicator& ranks_;
  SweepTable& table_;
  std::deque<std::size_t> missing_;
  SweepSummary& summary_;
  examples::Progress progress_;
  bool words_;
  std::size_t running_ = 0;

  // (a number is sent at once)
  void tell(int rank, long run) { MPI_Send(&run, 1, MPI_LONG, rank, ofRun, ranks_.handle()); }
  void give(int rank) {
    if (missing_.empty()) return;
    const std::size_t run = missing_.front();
    missing_.pop_front();
    ++running_;
    if (rank == 0)
      worker_.start(run);
    else
      tell(rank, long(run));
  }
  void take(int rank, std::string line) {
    std::size_t run = 0;
    if (!io::parse_number(std::string_view(line).substr(0, line.find(',')), run))
      throw Error("", text("rank ", rank, " has said what is no line of a table: '", line, "'"));
    give(rank);
    --running_;
    summary_.count(run - 1, line);
    table_.add(run - 1, std::move(line));
    if (words_) progress_.at(long(summary_.before + summary_.done));
  }
};

}  // namespace

int sweep_on_ranks(SweepOptions const& options, char** argv, mpi::Communicator& ranks, int& status) {
  status = badScene;
  std::signal(SIGPIPE, SIG_IGN);
  ranks.collectively("a sweep", [&] {
    try {
      if (!options.merge.empty())
        throw Failure{badUsage, {"--merge is not there with --mpi; leave --mpi out"}};
      Worker worker(argv, ranks.rank(), std::max(1, ranks.board().ranksHere()));
      const Known known = greeting(worker, ranks, status);
      status = badUsage;
      compare(known, ranks);
      if (ranks.rank() > 0) return follow(worker, ranks);
      std::deque<std::size_t> missing;
      SweepTable table(known.output, known.header, options.retry);
      std::size_t part = 0;
      for (std::size_t run = std::size_t(options.part - 1); run < known.header.runs;
           run += std::size_t(options.parts), ++part)
        if (!table.has(run)) missing.push_back(run);
      SweepSummary summary(options, known.output, known.header.runs, part);
      summary.before = part - missing.size();
      summary.ranks = ranks.size();
      summary.printStart();
      Leader(options, worker, ranks, table, std::move(missing), summary).run(std::max(1, options.jobs));
      table.sort();
      summary.printEnd();
    } catch (Failure const& failure) {
      status = failure.status;
      std::string all;
      for (auto const& message : failure.messages) all += text(all.empty() ? "" : "\n", message);
      throw Error("", all);
    }
  });
  return ok;
}

}  // namespace cli
