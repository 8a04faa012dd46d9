// SPDX-License-Identifier: BSL-1.0
#include "sinew_mpi/commands.hpp"

#include <sinew/io/pvd_series.hpp>
#include <sinew/mpi/registry.hpp>
#include <sinew/mpi/same_on_all.hpp>
#include <sinew/runtime/save_scene.hpp>

#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <optional>

namespace cli {

using namespace sinew;

namespace {

void refuse_options(RunOptions const& o) {
  const std::pair<char const*, bool> all[] = {{"--png", !o.png.empty()},
                                              {"--film", !o.film.empty()},
                                              {"--gltf", !o.gltf.empty()},
                                              {"--record", !o.record.empty()},
                                              {"--forces", !o.forces.empty()},
                                              {"--threads", o.threads > 0},
                                              {"--trace", !o.trace.empty()},
                                              {"--json", o.output == Output::json}};
  std::string first;
  for (auto const& [name, given] : all)
    if (given && first.empty()) first = name;
  if (!first.empty())
    throw Failure{
        badUsage,
        {text(first, " is not there with --mpi yet; leave it out, or run the scene in one process")}};
}

// A class that the registry does not have is distributed no more than one that nobody knows.
std::string not_distributed(std::string const& message) {
  constexpr std::string_view begin = "there is no component ";
  const std::size_t at = message.find(begin), end = at == message.npos ? at : message.find('>', at);
  if (end == message.npos) return message;
  return text(
      message.substr(0, at),
      message.substr(at + begin.size(), end + 1 - at - begin.size()),
      " is not distributed yet, or no component at all; leave it out, or run the scene without --mpi");
}

// What is said where this process is told to end: mpirun tells all where one of them was killed.
class Farewell {
 public:
  explicit Farewell(mpi::Communicator& ranks) {
    board() = &ranks.board();
    std::signal(SIGTERM, [](int) {
      char const* const words = now().load();
      if (words && board()->first() && ::write(2, words, std::strlen(words)) < 0) ::_exit(1);
      ::_exit(128 + SIGTERM);
    });
    say("the run is ended from outside, by somebody or since another rank was killed; without --save FILE "
        "--save-every K there is no checkpoint to go on from");
  }
  Farewell(Farewell const&) = delete;
  Farewell& operator=(Farewell const&) = delete;
  ~Farewell() { std::signal(SIGTERM, SIG_DFL); }

  void say(std::string const& words) {
    auto& next = words_[turn_ = 1 - turn_];
    next = text("sinew: ", words, '\n');
    now() = next.c_str();
  }

 private:
  std::array<std::string, 2> words_{};  // the one that is said, and the one before
  std::size_t turn_ = 0;
  static std::atomic<char const*>& now() {
    static std::atomic<char const*> words{nullptr};
    return words;
  }
  static mpi::Board*& board() {
    static mpi::Board* of = nullptr;
    return of;
  }
};

// The bodies over time, for ParaView: each rank writes the elements whose first point is its own, and rank 0
// what is only looked at.
class Pictures {
 public:
  Pictures(std::string folder, int rank, int ranks)
      : folder_(std::move(folder)), rank_(rank), ranks_(ranks) {}

  template <class Simulation>
  void add(Simulation& sim) {
    if (folder_.empty()) return;
    sim.bringGhosts();
    sim.ranks().collectively("pictures", [&] {
      traverse(sim.scope(), on<role::State>([&](auto& s, auto const& at) {
                 auto const [entry, isNew] = bodies_.try_emplace(at.path());
                 Body& body = entry->second;
                 if (isNew) describe(sim, s, at, body);
                 write(sim, s, body);
               }));
    });
    if (!shows(sim)) return;
    sim.look([&](auto const& whole) {
      traverse(whole, on<role::VisualModel>([&](auto& visual, auto const& at) {
                 auto& series = looks_.try_emplace(at.path(), folder_ + at.path()).first->second;
                 series.add(sim.time(), visual.current());
               }));
    });
  }
  /// Whether there is something to look at that no state has.
  template <class Simulation>
  static bool shows(Simulation& sim) {
    bool found = false;
    traverse(sim.scope(), on<role::VisualModel>([&](auto&, auto const&) { found = true; }));
    return found;
  }

 private:
  struct Body {
    Mesh mesh{};
    std::vector<std::size_t> points{};  // its own, and others of their elements
    bool elements = false;              // of the body there are some
    std::optional<io::PvdSeries> series{};
  };
  std::string folder_;
  int rank_, ranks_;
  std::map<std::string, Body> bodies_{};
  std::map<std::string, io::PvdSeries> looks_{};

  template <class Simulation, class State, class At>
  void describe(Simulation& sim, State const& s, At const& at, Body& body) {
    body.series.emplace(folder_ + at.path());
    mpi::Halo const& halo = sim.halo(s);
    auto isOwn = [&](std::size_t i) { return halo.parts[std::size_t(halo.numbers[i])] == rank_; };
    std::vector<Index> now(s.size(), -1);
    auto use = [&](Index i) {
      Index& n = now[std::size_t(i)];
      if (n < 0) n = Index(body.points.size()), body.points.push_back(std::size_t(i));
      return n;
    };
    auto add = [&](auto& to, auto const& from) {
      for (auto element : from) {
        body.elements = true;
        if (!isOwn(std::size_t(element[0]))) continue;
        for (Index& i : element) i = use(i);
        to.push_back(element);
      }
    };
    for (std::size_t i = 0; i < s.size(); ++i)
      if (isOwn(i)) use(Index(i));
    traverse(sim.scope(), on<role::Topology>([&](auto const& t, auto const& of) {
               if (of.pointsAddress() != static_cast<void const*>(&s)) return;
               const TopologyView view = t.view();
               add(body.mesh.triangles, view.triangles), add(body.mesh.quads, view.quads);
               add(body.mesh.tetrahedra, view.tetrahedra), add(body.mesh.hexahedra, view.hexahedra);
             }));
  }
  template <class Simulation, class State>
  void write(Simulation& sim, State const& s, Body& body) {
    io::PointArray velocity{"velocity", 3, {}}, rank{"rank", 1, {}}, number{"point", 1, {}};
    mpi::Halo const& halo = sim.halo(s);
    body.mesh.positions.clear();
    for (const std::size_t i : body.points) {
      body.mesh.positions.push_back(State::DataTypes::center(s.position[i]));
      velocity.values.insert(velocity.values.end(), s.velocity[i].data(), s.velocity[i].data() + 3);
      rank.values.push_back(double(halo.parts[std::size_t(halo.numbers[i])]));
      number.values.push_back(double(halo.numbers[i]));
    }
    body.series->addPiece(sim.time(), body.mesh, {velocity, rank, number}, {rank_, ranks_, !body.elements});
  }
};

// What the steps of each rank were made of, for `--profile`.
class Effort {
 public:
  template <class Simulation>
  explicit Effort(Simulation& sim) : start_(now(sim)) {}

  template <class Simulation>
  void print(Simulation& sim, double steps, double seconds) const {
    auto& ranks = sim.ranks();
    Numbers n = now(sim);
    for (std::size_t i = 0; i < n.size(); ++i) n[i] -= start_[i];
    double points = 0, ghosts = 0;
    traverse(sim.scope(), on<role::State>([&](auto& s, auto const&) {
               mpi::Halo const& halo = sim.halo(s);
               for (const Index i : halo.numbers)
                 ++(halo.parts[std::size_t(i)] == ranks.rank() ? points : ghosts);
             }));
    // the shortest of many sums over all ranks, and of many messages to the next one
    double latency = 1e9, message = 1e9;
    const int next = (ranks.rank() + 1) % ranks.size(),
              before = (ranks.rank() + ranks.size() - 1) % ranks.size();
    auto out = std::make_unique<std::vector<char>>(megabyte),
         in = std::make_unique<std::vector<char>>(megabyte);
    ranks.collectively("the time of messages", [&] {
      try {
        for (int i = 0; i < 500; ++i) {
          const double begin = MPI_Wtime();
          ranks.sum(1);
          latency = std::min(latency, MPI_Wtime() - begin);
        }
        for (int i = 0; i < 50; ++i) {
          const double begin = MPI_Wtime();
          MPI_Request both[] = {ranks.receive(before, in->data(), megabyte),
                                ranks.send(next, out->data(), megabyte)};
          ranks.wait(both, "a megabyte from the rank before");
          message = std::min(message, MPI_Wtime() - begin);
        }
      } catch (...) {
        mpi::keep(std::move(out)), mpi::keep(std::move(in));  // messages may be under way
        throw;
      }
    });
    std::vector<Line> all;
    ranks.collectively("the profile", [&] {
      all = ranks.gather(std::vector<Line>{{points,
                                            ghosts,
                                            n[exchanges] / steps,
                                            n[messages] / steps,
                                            n[bytes] / steps,
                                            n[sums] / steps,
                                            n[work] / steps,
                                            n[waited] / seconds,
                                            latency,
                                            message}},
                         std::vector<std::size_t>(std::size_t(ranks.size()), 1),
                         "the profile of all ranks");
    });
    if (ranks.rank() > 0) return;
    std::printf(
        "rank   points   ghosts  of a step: exchanges  messages      bytes    sums     work ms  waiting\n");
    for (std::size_t r = 0; r < all.size(); ++r) {
      Line const& l = all[r];
      std::printf("%4zu %8.0f %8.0f %21.1f %9.1f %10.0f %7.1f %10.4g %6.1f %%\n",
                  r,
                  l[0],
                  l[1],
                  l[2],
                  l[3],
                  l[4],
                  l[5],
                  1e3 * l[6],
                  100 * l[7]);
    }
    for (Line const& l : all) message = std::max(message, l[9]);
    std::printf("a sum over all ranks takes %.3g us, and 1 MB to the next rank %.3g us\n",
                1e6 * all[0][8],
                1e6 * message);
  }

 private:
  enum { exchanges, messages, bytes, sums, work, waited };
  using Numbers = std::array<double, 6>;
  using Line = std::array<double, 10>;
  static constexpr std::size_t megabyte = 1000000;
  Numbers start_;

  template <class Simulation>
  static Numbers now(Simulation& sim) {
    mpi::Traffic const& t = sim.traffic();
    return {double(t.exchanges),
            double(t.messages),
            double(t.bytes),
            double(sim.ranks().sums),
            double(std::clock()) / CLOCKS_PER_SEC - sim.ranks().spun,
            sim.ranks().waited};
  }
};

}  // namespace

int run_on_ranks(RunOptions const& options, std::shared_ptr<mpi::Communicator> const& ranks, int& status) {
  refuse_options(options);
  ranks->patience = options.patience;
  const bool first = ranks->rank() == 0, prints = first && options.output == Output::words;
  status = badScene;
  std::optional<ReadScene<mpi::Distributable>> read;
  ranks->collectively("the scene file", [&] {
    mpi::same_program_on_all(*ranks);
    mpi::same_file_on_all(*ranks, options.scene.path);
    const mpi::ReadTogether together(*ranks);
    try {
      read.emplace(read_scene<mpi::Distributable>(
          options.scene.path,
          {options.scene.data, options.scene.lenient, options.scene.set, options.scene.missing}));
    } catch (SceneError const& error) {
      std::string all;
      for (auto const& message : error.messages)
        all += text(all.empty() ? "" : "\n", not_distributed(message));
      throw Error("", all);
    }
  });
  const double dt = options.scene.dt > 0 ? options.scene.dt : read->dt;
  if (prints) {
    for (auto const& name : read->ignored)
      std::fprintf(stderr, "ignored, without a meaning here: %s\n", name.c_str());
    for (auto const& warning : read->warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  }
  Farewell farewell(*ranks);
  mpi::DistributedSimulation sim{std::move(read->root), ranks};
  if (!options.save.empty() || (!options.vtk.empty() && Pictures::shows(sim))) sim.keepWhole();
  sim.init([](auto const&) {}, read->time, read->step);
  const long steps = options.duration.time > 0 ? std::max(1L, std::lround(options.duration.time / dt))
                                               : options.duration.steps;
  if (prints) {
    std::printf("%s: on %d %s%s\n",
                options.scene.path.c_str(),
                ranks->size(),
                ranks->size() == 1 ? "rank" : "ranks",
                sim.step() > 0 ? text(", from step ", sim.step(), " on").c_str() : "");
    std::fflush(stdout);
  }
  auto save = [&] {
    auto const* const whole = sim.whole();
    ranks->collectively("a checkpoint", [&] {
      if (whole)
        io::write_file(options.save,
                       detail::SceneWriter<mpi::Distributable>().write(*whole, dt, sim.time(), sim.step()));
    });
    farewell.say(text("the run is ended from outside, by somebody or since another rank was killed; ",
                      options.save,
                      " has it up to step ",
                      sim.step(),
                      ", and 'sinew run ",
                      options.save,
                      " --mpi' goes on from there, on any number of ranks"));
  };
  Pictures pictures(options.vtk, ranks->rank(), ranks->size());
  status = notWritten;
  if (options.saveEvery > 0) save();
  pictures.add(sim);
  const Effort effort(sim);
  const auto start = std::chrono::steady_clock::now();
  for (long i = 1; i <= steps; ++i) {
    status = diverged;
    sim.animate(dt);
    status = notWritten;
    if (i % options.every == 0) pictures.add(sim);
    if (options.saveEvery > 0 && i % options.saveEvery == 0 && i < steps) save();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.save.empty()) save();
  if (prints)
    std::printf("%ld steps of %g s in %.3f s: %.0f steps/s, %.3g times real time\n",
                steps,
                dt,
                seconds,
                double(steps) / seconds,
                double(steps) * dt / seconds);
  if (options.profile && steps > 0) effort.print(sim, double(steps), seconds);
  return ok;
}

}  // namespace cli
