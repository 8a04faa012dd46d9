// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs MPI (Debian: libopenmpi-dev). Not in sinew.hpp; CMake's target sinew::mpi, there where MPI, PETSc and
// METIS are installed, brings it.
#include <sinew/core/error.hpp>
#include <sinew/mpi/board.hpp>

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// Holds memory to the end of the program, which MPI may still read or write where a rank has failed.
template <class T>
void keep(T memory) {
  static std::vector<T> all;
  all.push_back(std::move(memory));
}

/// What is thrown in a rank that waits, when another one has raised an error. collectively() turns it into
/// the error itself.
struct RaisedElsewhere : std::exception {
  char const* what() const noexcept override { return "another rank has raised an error"; }
};

/// Processes ("ranks") that work on one scene, with messages of their own. All waiting is done here, and it
/// ends: with what was waited for, with RaisedElsewhere, or after `patience` seconds with an Error that says
/// for what. Sums have the same bits on each rank and in each run.
class Communicator {
 public:
  double patience = 300;  // [s]
  // so far, by this rank: time that it has waited [s], what its processor took meanwhile [s], sums over all
  // ranks
  double waited = 0, spun = 0;
  long sums = 0;

  /// Of the same ranks as `of`; all of them have to call it.
  explicit Communicator(MPI_Comm of = MPI_COMM_WORLD) {
    MPI_Comm_dup(of, &comm_);
    MPI_Comm_dup(of, &errors_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
    buffers_->terms.resize(std::size_t(size_));
    board_.emplace(comm_);
  }
  Communicator(Communicator const&) = delete;
  Communicator& operator=(Communicator const&) = delete;
  ~Communicator() {
    int ended = 0;
    MPI_Finalized(&ended);
    if (failed_) keep(std::move(buffers_));
    if (ended || failed_) return;
    board_->close();
    MPI_Comm_free(&comm_);
    MPI_Comm_free(&errors_);
  }

  MPI_Comm handle() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  Board& board() { return *board_; }
  /// For those that wait for this rank: it is elsewhere than in collectively() until it is working() again.
  void inside(std::string_view what) { board_->write("is in ", what); }
  void working() { board_->write("works on ", doing_); }

  // messages, of which none is complete before wait()

  MPI_Request send(int to, void const* data, std::size_t bytes, int tag = 0) const {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(data, int(bytes), MPI_BYTE, to, tag, comm_, &request);
    return request;
  }
  MPI_Request receive(int from, void* data, std::size_t bytes, int tag = 0) const {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(data, int(bytes), MPI_BYTE, from, tag, comm_, &request);
    return request;
  }
  /// `what` is said of a wait that takes too long: "ghost points of rank 3".
  void wait(std::span<MPI_Request> requests, std::string_view what) {
    poll(what, [&] {
      int done = 0;
      MPI_Testall(int(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      return done != 0;
    });
  }

  /// To be called again and again while something else is waited for: where another rank has raised an
  /// error, throws RaisedElsewhere.
  void look(std::string_view what) {
    int raised = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, poke, errors_, &raised, MPI_STATUS_IGNORE);
    if (!raised) return;
    waited_ = what;
    throw RaisedElsewhere();
  }

  // what all ranks have to call

  /// The sum over all ranks, added in their order.
  double sum(double value, std::string_view what = "a sum over all ranks") {
    ++sums;
    MPI_Request request = MPI_REQUEST_NULL;
    buffers_->term = value;
    MPI_Iallgather(&buffers_->term, 1, MPI_DOUBLE, buffers_->terms.data(), 1, MPI_DOUBLE, comm_, &request);
    wait({&request, 1}, what);
    double all = 0;
    for (const double term : buffers_->terms) all += term;
    return all;
  }
  /// All ranks have come here.
  void meet(std::string_view what) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(comm_, &request);
    wait({&request, 1}, what);
  }
  /// Values of rank 0 go to all.
  template <class T>
  void broadcast(std::vector<T>& values, std::string_view what) {
    auto& b = *buffers_;
    b.count = values.size();
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&b.count, int(sizeof b.count), MPI_BYTE, 0, comm_, &request);
    wait({&request, 1}, what);
    values.resize(b.count);
    b.all.resize(b.count * sizeof(T));
    if (rank_ == 0) std::memcpy(b.all.data(), values.data(), b.all.size());
    MPI_Ibcast(b.all.data(), int(b.all.size()), MPI_BYTE, 0, comm_, &request);
    wait({&request, 1}, what);
    std::memcpy(static_cast<void*>(values.data()), b.all.data(), b.all.size());
  }
  /// Of each rank so many values, on all ranks, in the order of ranks.
  template <class T>
  std::vector<T> gather(std::vector<T> const& own, std::vector<std::size_t> const& counts,
                        std::string_view what) {
    std::vector<T> values;
    gather(
        own, [&](std::size_t r) { return counts[r]; }, values, what);
    return values;
  }
  /// The same of as many of each, into a list that is made long enough.
  template <class T>
  void gatherAlike(std::vector<T> const& own, std::vector<T>& values, std::string_view what) {
    gather(
        own, [&](std::size_t) { return own.size(); }, values, what);
  }

  /// What all ranks do together: f() on each. Where it throws on some, it ends on all, wherever they wait,
  /// and all throw one Error: that of the lowest rank that has raised one. The communicator is of no use
  /// then.
  template <class F>
  void collectively(std::string_view what, F&& f) {
    std::optional<std::string> said;
    doing_ = what;
    working();
    try {
      f();
      meet(what);
      return;
    } catch (RaisedElsewhere const&) {
    } catch (std::bad_alloc const&) {
      said = text("rank ",
                  rank_,
                  " of ",
                  size_,
                  ": out of memory; take more ranks on more machines, or fewer on one");
    } catch (std::exception const& error) {
      said = error.what();
    }
    throw Error("", agree(said));
  }
  /// Whether this rank is the one that has to report the error that all have thrown.
  bool reports() const { return reporter_ == rank_; }
  /// A rank has not answered when an error was raised: nothing but abort() ends the program.
  bool stuck() const { return stuck_; }

 private:
  static constexpr int poke = 1, told = 2;  // tags of errors
  static constexpr std::size_t length = 2000;
  struct Report {
    int raised;
    char words[length];
  };

  MPI_Comm comm_ = MPI_COMM_NULL, errors_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, reporter_ = 0;
  bool failed_ = false, stuck_ = false;
  std::string waited_{};  // for what, when an error came
  std::string doing_{};
  std::optional<Board> board_{};
  // MPI may read and write these after a wait that has ended by an error, until it ends itself
  struct Buffers {
    double term = 0;
    std::vector<double> terms{};
    std::size_t count = 0;
    std::vector<int> counts{}, starts{};
    std::vector<std::byte> own{}, all{};
    Report report{};
    std::vector<Report> reports{};
    std::vector<MPI_Request> sent{}, come{};
  };
  std::unique_ptr<Buffers> buffers_ = std::make_unique<Buffers>();

  // counts(rank) values of each rank
  template <class T, class Counts>
  void gather(std::vector<T> const& own, Counts&& counts, std::vector<T>& values, std::string_view what) {
    auto& b = *buffers_;
    b.counts.clear(), b.starts.clear();
    int end = 0;
    for (std::size_t r = 0; r < std::size_t(size_); ++r) {
      b.starts.push_back(end);
      b.counts.push_back(int(counts(r) * sizeof(T)));
      end += b.counts.back();
    }
    const auto bytes = reinterpret_cast<std::byte const*>(own.data());
    b.own.assign(bytes, bytes + b.counts[std::size_t(rank_)]);
    b.all.resize(std::size_t(end));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgatherv(b.own.data(),
                    int(b.own.size()),
                    MPI_BYTE,
                    b.all.data(),
                    b.counts.data(),
                    b.starts.data(),
                    MPI_BYTE,
                    comm_,
                    &request);
    wait({&request, 1}, what);
    values.resize(std::size_t(end) / sizeof(T));
    std::memcpy(static_cast<void*>(values.data()), b.all.data(), b.all.size());
  }

  template <class Done>
  void poll(std::string_view what, Done&& done) {
    if (done()) return;
    board_->write("waits for ", what);
    const double start = MPI_Wtime();
    const std::clock_t before = std::clock();
    while (!done()) {
      look(what);
      if (MPI_Wtime() - start > patience)
        throw Error("",
                    text("rank ",
                         rank_,
                         " of ",
                         size_,
                         " has waited ",
                         patience,
                         " s for ",
                         what,
                         "; look at the ranks that do not answer, or give it more patience"));
      std::this_thread::yield();
    }
    waited += MPI_Wtime() - start;
    spun += double(std::clock() - before) / CLOCKS_PER_SEC;
    working();
  }

  // each rank tells each other whether it has raised an error, and where it was
  std::string agree(std::optional<std::string> const& said) {
    failed_ = true;
    std::vector<Report>& reports = buffers_->reports;
    std::vector<MPI_Request>&sent = buffers_->sent, &come = buffers_->come;
    Report& own = buffers_->report;
    reports.assign(std::size_t(size_), Report{});
    sent.assign(2 * std::size_t(size_), MPI_REQUEST_NULL);
    come.assign(std::size_t(size_), MPI_REQUEST_NULL);
    own.raised = said ? 1 : 0;
    std::string const& words = said ? *said : waited_;
    std::memcpy(own.words, words.data(), std::min(words.size(), length - 1));
    const int bytes = int(sizeof own);
    for (int r = 0; r < size_; ++r) {
      const std::size_t i = std::size_t(r);
      if (r == rank_) continue;
      if (said) MPI_Isend(nullptr, 0, MPI_BYTE, r, poke, errors_, &sent[2 * i]);
      MPI_Isend(&own, bytes, MPI_BYTE, r, told, errors_, &sent[2 * i + 1]);
      MPI_Irecv(&reports[i], bytes, MPI_BYTE, r, told, errors_, &come[i]);
    }
    reports[std::size_t(rank_)] = own;
    const double start = MPI_Wtime();
    std::vector<int> answered(std::size_t(size_), 0);
    answered[std::size_t(rank_)] = 1;
    while (std::count(answered.begin(), answered.end(), 1) < size_ &&
           MPI_Wtime() - start < std::min(patience, 10.0)) {
      for (std::size_t r = 0; r < answered.size(); ++r)
        if (!answered[r]) MPI_Test(&come[r], &answered[r], MPI_STATUS_IGNORE);
      std::this_thread::yield();
    }
    return message(reports, answered);
  }
  std::string message(std::vector<Report> const& reports, std::vector<int> const& answered) {
    reporter_ = -1;
    int raised = 0;
    std::string first, others;
    for (int r = 0; r < size_; ++r) {
      Report const& report = reports[std::size_t(r)];
      raised += report.raised;
      if (!answered[std::size_t(r)]) {
        stuck_ = true;
        const std::string where = board_->read(r);
        others += text("; rank ", r, " does not answer", where.empty() ? "" : ": it ", where);
      } else if (report.raised && reporter_ < 0) {
        reporter_ = r;
        first = report.words;
      }
    }
    if (raised < size_ && first.rfind("rank ", 0) != 0)
      first = text("rank ", reporter_, " of ", size_, ": ", first);
    // of one that has waited for too long, where the others are
    if (first.find(" has waited ") != std::string::npos)
      for (int r = 0; r < size_; ++r)
        if (answered[std::size_t(r)] && !reports[std::size_t(r)].raised)
          others += text("; rank ", r, " waits for ", reports[std::size_t(r)].words);
    return first + others;
  }
};

/// MPI from here to the end of its life: the first thing in main(). Ends all ranks where main() is left by an
/// error that not all of them have.
class Session {
 public:
  Session(int& argc, char**& argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_ARE_FATAL);
  }
  Session(Session const&) = delete;
  Session& operator=(Session const&) = delete;
  ~Session() { MPI_Finalize(); }
};

/// Reports an error that all ranks of a communicator have thrown, once, and says with which status the
/// program has to end. Where a rank does not answer, it ends all of them.
inline int report(Communicator const& ranks, std::exception const& error) {
  if (ranks.reports()) std::fprintf(stderr, "%s\n", error.what());
  if (ranks.stuck()) {
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 1;
}

}  // namespace sinew::mpi
