// SPDX-License-Identifier: BSL-1.0
// The program sinew-mpi, to which `sinew run scene.scn --mpi` hands over: mpirun starts it in several
// processes, which step the scene together.
#include "sinew/options.hpp"

#include <sinew/io/pvd_series.hpp>
#include <sinew/mpi/registry.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

namespace {

using namespace sinew;

// what is said to all ranks alike is printed by the first one
struct Silence {
  int out = -1, error = -1;
  explicit Silence(bool silent) {
    if (!silent) return;
    const int nowhere = open("/dev/null", O_WRONLY);
    out = dup(1), error = dup(2);
    dup2(nowhere, 1), dup2(nowhere, 2);
    close(nowhere);
  }
  Silence(Silence const&) = delete;
  Silence& operator=(Silence const&) = delete;
  ~Silence() {
    if (out < 0) return;
    std::fflush(stdout), std::fflush(stderr);
    dup2(out, 1), dup2(error, 2);
    close(out), close(error);
  }
};

void refuse_options(cli::RunOptions const& o) {
  const std::pair<char const*, bool> all[] = {{"--png", !o.png.empty()},
                                              {"--film", !o.film.empty()},
                                              {"--gltf", !o.gltf.empty()},
                                              {"--record", !o.record.empty()},
                                              {"--forces", !o.forces.empty()},
                                              {"--save", !o.save.empty()},
                                              {"--threads", o.threads > 0},
                                              {"--profile", o.profile},
                                              {"--trace", !o.trace.empty()},
                                              {"--json", o.output == cli::Output::json}};
  std::string first;
  for (auto const& [name, given] : all)
    if (given && first.empty()) first = name;
  if (!first.empty())
    throw cli::Failure{
        cli::badUsage,
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

// the bodies over time, for ParaView, by rank 0
class Pictures {
 public:
  Pictures(std::string folder, bool writes) : folder_(std::move(folder)), writes_(writes) {}

  template <class Scope>
  void take(Scope const& whole) {
    if (folder_.empty() || !writes_) return;
    traverse(whole, on<role::Topology>([&](auto const& t, auto const& at) {
               Body& body = bodies_[at.stateScope().path()];
               auto add = [](auto& to, auto const& from) { to.insert(to.end(), from.begin(), from.end()); };
               const TopologyView view = t.view();
               add(body.mesh.triangles, view.triangles), add(body.mesh.quads, view.quads);
               add(body.mesh.tetrahedra, view.tetrahedra), add(body.mesh.hexahedra, view.hexahedra);
             }));
  }
  template <class Simulation>
  void add(Simulation& sim) {
    if (folder_.empty()) return;
    traverse(sim.scope(), on<role::State>([&](auto& s, auto const& at) {
               const auto x = sim.everywhere(s, vec_id::position), v = sim.everywhere(s, vec_id::velocity);
               if (!writes_) return;
               Body& body = bodies_[at.path()];
               body.mesh.positions = x;
               io::PointArray velocity{"velocity", 3, {}};
               for (auto const& u : v) velocity.values.insert(velocity.values.end(), u.data(), u.data() + 3);
               if (!body.series) body.series.emplace(folder_ + at.path());
               body.series->add(sim.time(), body.mesh, {velocity});
             }));
  }

 private:
  struct Body {
    Mesh mesh{};
    std::optional<io::PvdSeries> series{};
  };
  std::string folder_;
  bool writes_;
  std::map<std::string, Body> bodies_{};
};

int run(cli::RunOptions const& options, std::shared_ptr<mpi::Communicator> const& ranks, int& status) {
  refuse_options(options);
  const bool prints = ranks->rank() == 0 && options.output == cli::Output::words;
  status = cli::badScene;
  std::optional<ReadScene<mpi::Distributable>> read;
  ranks->collectively("read", [&] {
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
  Pictures pictures(options.vtk, ranks->rank() == 0);
  mpi::DistributedSimulation sim{std::move(read->root), ranks};
  sim.init([&](auto const& whole) { pictures.take(whole); });
  const long steps = options.duration.time > 0 ? std::max(1L, std::lround(options.duration.time / dt))
                                               : options.duration.steps;
  if (prints) {
    std::printf(
        "%s: on %d %s\n", options.scene.path.c_str(), ranks->size(), ranks->size() == 1 ? "rank" : "ranks");
    std::fflush(stdout);
  }
  status = cli::diverged;
  pictures.add(sim);
  const auto start = std::chrono::steady_clock::now();
  for (long i = 1; i <= steps; ++i) {
    sim.animate(dt);
    if (i % options.every == 0) pictures.add(sim);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (prints)
    std::printf("%ld steps of %g s in %.3f s: %.0f steps/s, %.3g times real time\n",
                steps,
                dt,
                seconds,
                double(steps) / seconds,
                double(steps) * dt / seconds);
  return cli::ok;
}

}  // namespace

int main(int argc, char** argv) {
  sinew::mpi::Session session(argc, argv);
  const sinew::mpi::PetscSession petsc;
  const auto ranks = std::make_shared<sinew::mpi::Communicator>();
  int status = cli::ok;
  try {
    cli::Options options;
    {
      const Silence silence(ranks->rank() != 0);
      options = cli::read_options(argc, argv, status);
    }
    if (options.command == cli::Command::none) return status;
    if (options.command != cli::Command::run)
      throw cli::Failure{cli::badUsage,
                         {"sinew-mpi: several processes can run scenes only: sinew run FILE --mpi"}};
    return run(options.run, ranks, status);
  } catch (cli::Failure const& failure) {
    if (ranks->rank() == 0)
      for (auto const& message : failure.messages) std::fprintf(stderr, "%s\n", message.c_str());
    return failure.status;
  } catch (std::exception const& error) {
    sinew::mpi::report(*ranks, error);
    return status;
  }
}
