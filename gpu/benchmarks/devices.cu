// SPDX-License-Identifier: BSL-1.0
// Steps a second over several GPUs, against one:
//   devices implicit CELLS | explicit CELLS | copies FILE.msh|CELLS COPIES
//           [--double] [--steps N] [--devices N] [--no-simulation]
// A unit cube of CELLS^3 cells of six tetrahedra, corotational, held at three points: implicit Euler with 25
// iterations of conjugate gradients over the assembled matrix, or explicit Euler. The step of Simulation, as
// a graph on one GPU; then DistributedSimulation on 1, 2, .. devices, with the largest difference of
// positions from those on one, over the size of the body, after ten steps. Copies: DistributedCopies, 25
// iterations. Prints a line each: scene; points; tetrahedra; real; form; steps a second, the median of five;
// times one device; difference.
#include <sinew/gpu/distributed/copies.hpp>
#include <sinew/gpu/distributed/simulation.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/io/read_gmsh.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "../../benchmarks/run/scenes.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace bench;

namespace {

struct Options {
  std::string scene{};
  bool simulation = true;
  int steps = 20, devices = 0;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
// steps a second of what `run` does n times, the median of five
template <class Run>
double rate(int steps, Run&& run) {
  run();
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    const double start = now();
    run();
    times.push_back(now() - start);
  }
  std::sort(times.begin(), times.end());
  return steps / times[2];
}

template <class D, class Sim>
void measure(Mesh const& mesh, Options const& o, Sim sim, double dt) {
  const double start = now();
  sim.init();
  std::printf("# scene made in %.1f s\n", now() - start);
  double alone = 0;
  auto line = [&](std::string const& form, double rate, double far) {
    std::printf("%s; %zu; %zu; %s; %s; %.2f; %.3f; %.1e\n",
                o.scene.c_str(),
                mesh.positions.size(),
                mesh.tetrahedra.size(),
                sizeof(typename D::Real) == 8 ? "double" : "float",
                form.c_str(),
                rate,
                alone > 0 ? rate / alone : 1,
                far);
    std::fflush(stdout);
  };
  std::vector<typename D::Coord> first;
  const std::vector<typename D::Coord> rest = std::as_const(sim.root().state().position).host();
  for (int n = 1; n <= o.devices; n *= 2) {
    std::vector<int> devices;
    for (int d = 0; d < n; ++d) devices.push_back(d);
    const double begin = now();
    gpu::DistributedSimulation parts(sim, devices);
    std::printf("# %d parts made in %.1f s\n", n, now() - begin);
    parts.animate(dt, 10);
    parts.finish();
    auto& state = sim.root().state();
    const auto was = std::pair(state.position, state.velocity);
    parts.store(sim);
    auto const& x = std::as_const(state.position).host();
    double far = 0, moved = 0;
    if (first.empty()) first = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      far = std::max(far, double((x[i] - first[i]).norm()));
      moved = std::max(moved, double((x[i] - rest[i]).norm()));
    }
    state.position = was.first;
    state.velocity = was.second;
    sim.continueFrom(0, 0);
    const double found = rate(o.steps, [&] {
      parts.animate(dt, o.steps);
      parts.finish();
    });
    if (n == 1) alone = found;
    for (std::size_t k = 0; k < parts.parts(); ++k)
      std::printf("# part of %zu points and %zu of others\n", parts.points(k).first, parts.points(k).second);
    std::printf("# moved %.2e\n", moved);
    line(text(n, n > 1 ? " devices" : " device"), found, far);
  }
  if (!o.simulation) return;
  gpu::RecordedStep recorded(sim, dt);
  line("Simulation, as a graph",
       rate(o.steps,
            [&] {
              recorded.animate(o.steps);
              recorded.finish();
            }),
       0);
}

template <class D>
void copies(Mesh const& mesh, int count, Options const& o) {
  auto sim = body<D>(mesh, all_iterations<GraphScattered>());
  sim.init();
  double alone = 0;
  for (int n = 1; n <= o.devices; n *= 2) {
    std::vector<int> devices;
    for (int d = 0; d < n; ++d) devices.push_back(d);
    gpu::DistributedCopies all(sim, count, devices);
    all.animate(0.02, 2);
    all.finish();
    const double found = count * rate(o.steps, [&] {
                           all.animate(0.02, o.steps);
                           all.finish();
                         });
    if (n == 1) alone = found;
    std::printf("%s; %zu; %zu; %s; %d copies, %d devices; %.0f; %.3f; 0\n",
                o.scene.c_str(),
                mesh.positions.size(),
                mesh.tetrahedra.size(),
                sizeof(typename D::Real) == 8 ? "double" : "float",
                count,
                n,
                found,
                found / alone);
    std::fflush(stdout);
  }
}

template <class D>
void run(std::vector<std::string> const& words, Options o) {
  o.scene = words[0];
  const bool cells = words[1].find_first_not_of("0123456789") == std::string::npos;
  const Mesh mesh = cells ? block(std::atoi(words[1].c_str())) : io::read_gmsh(words[1]);
  if (o.scene == "implicit" && words.size() == 2)
    measure<D>(mesh, o, body<D>(mesh, all_iterations<CompressedRowSparseMatrixMat3x3d>()), 0.02);
  else if (o.scene == "explicit" && words.size() == 2)
    measure<D>(mesh, o, solved_body<D>(mesh, corotational<D>(), EulerExplicitSolver{}), 2e-5);
  else if (o.scene == "copies" && words.size() == 3)
    copies<D>(mesh, std::atoi(words[2].c_str()), o);
  else
    throw Error("arguments", "implicit CELLS | explicit CELLS | copies FILE.msh|CELLS COPIES");
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> words;
  bool inDouble = false;
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--double")
      inDouble = true;
    else if (word == "--no-simulation")
      o.simulation = false;
    else if (word == "--steps" && i + 1 < argc)
      o.steps = std::atoi(argv[++i]);
    else if (word == "--devices" && i + 1 < argc)
      o.devices = std::atoi(argv[++i]);
    else
      words.push_back(word);
  }
  if (o.devices <= 0) o.devices = gpu::device_count();
  if (words.size() < 2 || o.steps < 1)
    throw Error(
        "arguments",
        "devices implicit CELLS | explicit CELLS | copies FILE.msh|CELLS COPIES [--double] [--steps N] "
        "[--devices N] [--no-simulation]");
  if (inDouble)
    run<CudaVec3d>(words, o);
  else
    run<CudaVec3f>(words, o);
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "devices: %s\n", error.what());
  return 1;
}
