// SPDX-License-Identifier: BSL-1.0
// Steps a second of the scenes of the table on a GPU, in all forms in turn: launched loop by loop, the step
// as a CUDA graph, the fused step.
//   scenes grid NX NY NZ | fem FILE.msh | block CELLS | hexahedra CELLS | hyperelastic CELLS
//          | batch FILE.msh|CELLS COPIES
//          [--double] [--steps N] [--iterations N] [--no-host] [--no-plain] [--no-fused] [--blocks N]...
//          [--profile plain|assembled|fused]
// Bodies of CELLS are unit cubes of so many cells along each edge.
// Prints first what the GPU does at best, then for each form: scene; points; elements; real; form; steps a
// second, by events around so many steps, the median of five; how far point 100 is, over the largest
// coordinate, from where the processor has it after the first 50 steps; and what Work says of that. With
// --profile nothing is measured: one step of that form (ten of a fused one, in one launch) is made for a
// profiler to look at; profile.py calls it.
#include "ceilings.hpp"

#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/gpu/fused/simulation.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/io/read_gmsh.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include "../../benchmarks/run/law_flops.hpp"
#include "../../benchmarks/run/scenes.hpp"

#include <cuda_profiler_api.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace bench;

namespace {

constexpr double dt = 0.02;
constexpr int compared = 50;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// a cube of hexahedra, and one of a compressible Neo-Hookean solid, held at the side x = 0
std::vector<int> held(Mesh const& mesh) {
  std::vector<int> at;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][0] < 1e-9) at.push_back(int(i));
  return at;
}
template <class D, class Linear>
auto hexahedra(int n, Linear linear) {
  const Mesh mesh = regular_grid(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}},
                                 EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                                 linear,
                                 MeshTopology{.position = mesh.positions, .hexahedra = mesh.hexahedra},
                                 MechanicalObject<D>{},
                                 DiagonalMass<D>{.massDensity = 1},
                                 HexahedronFEMForceField<D>{.youngModulus = {3000}, .poissonRatio = 0.3},
                                 FixedConstraint<D>{.indices = held(mesh)})};
}
template <class D, class Linear>
auto hyperelastic(Mesh const& mesh, Linear linear) {
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                   linear,
                   TetrahedronTopology{mesh.tetrahedra},
                   MechanicalObject<D>{points_of<D>(mesh)},
                   DiagonalMass<D>{.massDensity = 1},
                   TetrahedronHyperelasticityFEMForceField<D>{
                       .materialName = HyperelasticMaterial::NeoHookean, .parameterSet = {1200, 2500}},
                   FixedConstraint<D>{.indices = held(mesh)})};
}

/// What a step of the method must compute, and the bytes that it must read and write where nothing stays on
/// the chip: each array once for each time that it is written or read.
///   elements    force, one product for the right-hand side, blocks; rest data, tangents twice, points
///   iterations  the product with blocks of 3 x 3, 10 flops a scalar for vectors; blocks with their columns,
///               12 passes over vectors
/// A form may do more (blocks twice, one for each side), and a fused step reads no block from memory.
struct Work {
  double flops = 0, bytes = 0, flopsOfIteration = 0, bytesOfIteration = 0;

  double flopsAt(int iterations) const { return flops + iterations * flopsOfIteration; }
  double bytesAt(int iterations) const { return bytes + iterations * bytesOfIteration; }
};
// blocks of the matrix: two points that share an element have one, and each point with itself
template <std::size_t Arity>
double matrix_blocks(std::vector<std::array<int, Arity>> const& elements, std::size_t points) {
  std::vector<std::size_t> first(points + 1, 0);
  for (auto const& e : elements)
    for (const int i : e) ++first[std::size_t(i) + 1];
  for (std::size_t i = 0; i < points; ++i) first[i + 1] += first[i];
  std::vector<int> around(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int i : elements[e]) around[next[std::size_t(i)]++] = int(e);
  double blocks = 0;
  std::vector<int> row;
  for (std::size_t i = 0; i < points; ++i) {
    row.assign(1, int(i));
    for (std::size_t k = first[i]; k < first[i + 1]; ++k)
      for (const int j : elements[std::size_t(around[k])]) row.push_back(j);
    std::sort(row.begin(), row.end());
    blocks += double(std::unique(row.begin(), row.end()) - row.begin());
  }
  return blocks;
}
template <class Driver>
Work work_of(Driver const& driver, LawFlops const& law, std::size_t pointCount) {
  using Real = typename Driver::Real;
  const double elements = double(driver.size()), points = double(pointCount);
  const double blocks = matrix_blocks(driver.elements, pointCount), block = 9 * sizeof(Real);
  Work w;
  w.flops = elements * (law.force + law.dforce + law.blocks);
  w.bytes = elements * (sizeof(typename Driver::Rest) + 2 * sizeof(typename Driver::Tangent) +
                        Driver::arity * sizeof(int)) +
            blocks * block;
  w.flopsOfIteration = 18 * blocks + 30 * points;
  w.bytesOfIteration = blocks * (block + sizeof(int)) + 12 * points * 3 * sizeof(Real);
  return w;
}

/// What the GPU does at best for work of that kind, measured in the same run.
struct Best {
  double flops, bytes;  // a second; of a copy of as many bytes as an iteration reads and writes
};
template <class Real>
Best best_for(Work const& work) {
  const Best best{peak<Real>(), copy_bandwidth(std::size_t(work.bytesOfIteration))};
  std::printf(
      "best; %.1f Tflop/s; a copy of %.2f MB: %.0f GB/s; a launch takes %.2f us, in a graph %.2f us\n",
      best.flops / 1e12,
      work.bytesOfIteration / 1e6,
      best.bytes / 1e9,
      launch_seconds() * 1e6,
      node_seconds() * 1e6);
  return best;
}

template <class X, class Y>
double difference(X const& x, Y const& y) {
  double far = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      far = std::max(far, std::abs(double(x[i][c]) - double(y[i][c])));
      size = std::max(size, std::abs(double(y[i][c])));
    }
  return far / size;
}

struct Options {
  std::string scene{};
  int steps = 200, iterations = 25;
  bool host = true, plain = true, fused = true;
  // of a fused step, in turn; 0 is what it chooses, more than 16 are those of a launch
  std::vector<int> blocks{};
  int copies = 0;
  std::string profile{};
};

/// What a profiler that is told not to start by itself looks at.
template <class Steps>
void watched(Steps&& steps) {
  gpu::wait();
  gpu::check(cudaProfilerStart(), "--profile");
  steps();
  gpu::wait();
  gpu::check(cudaProfilerStop(), "--profile");
}

// make.template operator()<D>(linear) is the scene over D with that linear solver
template <class H, class Make>
void measure(Make const& make, LawFlops const& law, Options const& o) {
  using Cuda = CudaTypes<H>;
  using Real = typename H::Real;
  const auto plain = all_iterations<GraphScattered>(o.iterations);
  const int fewer = std::max(1, o.iterations / 5);
  auto field = [](auto& sim) -> auto& {
    return *std::get<0>(components_that<gpu::detail::IsForceField>(components_of(sim.root())));
  };
  auto solver = [](auto& sim) -> auto& { return sim.root().template first<role::LinearSolver>(); };

  using Matrix = std::
      conditional_t<sizeof(Real) == 8, CompressedRowSparseMatrixMat3x3d, CompressedRowSparseMatrixMat3x3f>;
  if (!o.profile.empty()) {
    auto once = [](auto of) {
      of.init();
      for (int i = 0; i < 3; ++i) of.animate(dt);
      watched([&] { of.animate(dt); });
    };
    if (o.profile == "plain") return once(make.template operator()<Cuda>(plain));
    if (o.profile == "assembled")
      return once(make.template operator()<Cuda>(all_iterations<Matrix>(o.iterations)));
    auto of = make.template operator()<Cuda>(plain);
    of.init();
    gpu::FusedSimulation fused(of, 1, o.blocks.front());
    fused.animate(dt, 3);
    return watched([&] { fused.animate(dt, 10); });
  }
  auto sim = make.template operator()<Cuda>(plain);
  const double start = now();
  sim.init();
  const auto points = sim.root().state().size(), elements = field(sim).driver.size();
  const bool small = elements < 200000;
  const Work work = work_of(field(sim).driver, law, points);
  const Best best = best_for<Real>(work);
  auto name = [&](std::string const& form) {
    std::printf("%s; %zu; %zu; %s; %s; ",
                o.scene.c_str(),
                points,
                elements,
                sizeof(Real) == 8 ? "double" : "float",
                form.c_str());
  };
  // seconds(k) are those of a step with so many iterations
  auto line = [&](std::string const& form, double far, auto&& seconds) {
    const double step = seconds(o.iterations);
    const double each = (step - seconds(fewer)) / (o.iterations - fewer);
    name(form);
    std::printf(
        "%.1f; %.1e; %.2f us an iteration, %.1f us besides; %.1f Gflop/s, %.2f %%; %.0f GB/s, %.1f %%; "
        "iterations %.0f GB/s, %.1f %%\n",
        1 / step,
        far,
        each * 1e6,
        (step - o.iterations * each) * 1e6,
        work.flopsAt(o.iterations) / step / 1e9,
        100 * work.flopsAt(o.iterations) / step / best.flops,
        work.bytesAt(o.iterations) / step / 1e9,
        100 * work.bytesAt(o.iterations) / step / best.bytes,
        work.bytesOfIteration / each / 1e9,
        100 * work.bytesOfIteration / each / best.bytes);
    std::fflush(stdout);
  };

  const int same = small ? compared : 2;
  auto reference = make.template operator()<H>(plain);
  if (o.host) {
    reference.init();
    const double begin = now();
    for (int i = 0; i < same; ++i) reference.animate(dt);
    name("processor, one thread, without lanes");
    std::printf("%.1f\n", same / (now() - begin));
  }
  auto far = [&](auto& of) {
    return o.host ? difference(std::as_const(of.root().state().position), reference.root().state().position)
                  : 0;
  };
  if (o.plain) {
    sim.animate(dt);
    gpu::wait();
    std::fprintf(stderr, "device init and first step %.2f s\n", now() - start);
    for (int i = 1; i < same; ++i) sim.animate(dt);
    line("launch by launch", far(sim), [&](int iterations) {
      solver(sim).iterations = iterations;
      return event_seconds([&] {
               for (int i = 0; i < o.steps; ++i) sim.animate(dt);
             }) /
             o.steps;
    });
    auto graph = [&](char const* form, auto& of) {
      line(form, 0, [&](int iterations) {
        solver(of).iterations = iterations;
        gpu::RecordedStep recorded(of, dt);
        recorded.animate();
        return event_seconds([&] { recorded.animate(o.steps); }) / o.steps;
      });
    };
    auto another = [&](char const* form, auto linear) {
      auto made = make.template operator()<Cuda>(linear);
      made.init();
      graph(form, made);
    };
    using Matrix = std::
        conditional_t<sizeof(Real) == 8, CompressedRowSparseMatrixMat3x3d, CompressedRowSparseMatrixMat3x3f>;
    graph("graph", sim);
    another("graph, assembled", all_iterations<Matrix>());
    another("graph, assembled, block-Jacobi", ShewchukPCGLinearSolver<Matrix>{.tolerance = 0});
  }
  if (o.fused)
    for (const int blocks : o.blocks) {
      auto made = make.template operator()<Cuda>(plain);
      made.init();
      try {
        auto fusedOf = [&](int iterations) {
          solver(made).iterations = iterations;
          return gpu::FusedSimulation(made, 1, blocks);
        };
        auto compare = fusedOf(o.iterations);
        compare.animate(dt, same);
        compare.finish();
        const auto shape = compare.shape();
        const std::string form =
            text("fused, ", shape.blocks, " x ", shape.threads, blocks == 0 ? " (chosen)" : "");
        auto there = make.template operator()<Cuda>(plain);
        there.init();
        compare.store(0, there);
        const double away = far(there);
        auto seconds = [&](int launches) {
          return [&, launches](int iterations) {
            auto fused = fusedOf(iterations);
            fused.animate(dt, compared);
            const double all = event_seconds([&] {
              for (int i = 0; i < launches; ++i) fused.animate(dt, o.steps / launches);
            });
            fused.finish();
            return all / (o.steps / launches * launches);
          };
        };
        line(form + ", one launch a step", away, seconds(o.steps));
        line(form + ", all steps in one launch", away, seconds(1));
      } catch (Error const& error) {
        std::fprintf(stderr, "%d blocks: %s\n", blocks, error.what());
      }
    }
}

// copies of one body with different stiffness
template <class H>
void batch(Mesh const& mesh, Options const& o) {
  using Cuda = CudaTypes<H>;
  const auto linear = all_iterations<GraphScattered>(o.iterations);
  auto sim = body<Cuda>(mesh, linear);
  sim.init();
  auto softer = body<Cuda>(mesh, linear, 2500);
  softer.init();
  if (!o.profile.empty()) {
    gpu::FusedSimulation fused(sim, o.copies);
    fused.animate(dt, 3);
    return watched([&] { fused.animate(dt, 10); });
  }
  auto const& driver = sim.root().template first<role::ForceField>().driver;
  const double flops = work_of(driver, tetrahedron_flops(), mesh.positions.size()).flopsAt(o.iterations);
  const double best = peak<typename H::Real>();
  for (int copies = 1; copies <= o.copies; copies *= 4) {
    gpu::FusedSimulation fused(sim, copies);
    for (int c = 1; c < copies; c += 2) fused.load(c, softer);
    const int steps = std::max(2, o.steps / std::max(1, copies / 256));
    fused.animate(dt, 2);
    fused.finish();
    const double seconds = event_seconds([&] { fused.animate(dt, steps); }) / steps;
    fused.finish();
    std::printf(
        "batch %s; %zu; %zu; %s; %d copies, %d x %d; %.1f steps a second of all; %.0f of one; "
        "%.1f Gflop/s, %.2f %%\n",
        o.scene.c_str(),
        mesh.positions.size(),
        mesh.tetrahedra.size(),
        sizeof(typename H::Real) == 8 ? "double" : "float",
        copies,
        fused.shape().blocks,
        fused.shape().threads,
        1 / seconds,
        copies / seconds,
        copies * flops / seconds / 1e9,
        100 * copies * flops / seconds / best);
    std::fflush(stdout);
  }
}

int number(std::string const& word, int minimum) {
  char* end = nullptr;
  const long value = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end || value < minimum || value > 1000000000)
    throw Error("arguments", text("'", word, "' is not a whole number of at least ", minimum));
  return int(value);
}
// of a file, or a cube of so many cells; its points 3, 39 and 64 are held
Mesh mesh_of(std::string const& word) {
  const bool cells = word.find_first_not_of("0123456789") == std::string::npos;
  return cells ? block(number(word, 4)) : io::read_gmsh(word);
}

template <class H>
void run(std::vector<std::string> const& words, Options o) {
  std::string const& scene = words[0];
  auto has = [&](char const* name, std::size_t arguments) {
    if (scene != name) return false;
    if (words.size() != arguments + 1)
      throw Error("arguments", text(scene, " is followed by ", arguments, " of them"));
    return true;
  };
  auto fileName = [&] { return words[1].substr(words[1].find_last_of('/') + 1); };
  o.scene = scene;
  if (has("grid", 3)) {
    const std::array<int, 3> n{number(words[1], 2), number(words[2], 2), number(words[3], 2)};
    o.scene = text("grid ", n[0], "x", n[1], "x", n[2]);
    measure<H>([&]<class D>(auto linear) { return spring_grid<D>(n, linear); }, spring_flops(), o);
  } else if (has("hexahedra", 1)) {
    const int n = number(words[1], 1);
    measure<H>([&]<class D>(auto linear) { return hexahedra<D>(n, linear); }, hexahedron_flops(), o);
  } else if (has("hyperelastic", 1)) {
    const Mesh mesh = block(number(words[1], 1));
    measure<H>([&]<class D>(auto linear) { return hyperelastic<D>(mesh, linear); }, hyperelastic_flops(), o);
  } else if (has("batch", 2)) {
    o.scene = fileName();
    o.copies = number(words[2], 1);
    batch<H>(mesh_of(words[1]), o);
  } else if (has("fem", 1) || has("block", 1)) {
    const Mesh mesh = scene == "fem" ? io::read_gmsh(words[1]) : block(number(words[1], 4));
    if (scene == "fem") o.scene = fileName();
    measure<H>([&]<class D>(auto linear) { return body<D>(mesh, linear); }, tetrahedron_flops(), o);
  } else {
    throw Error(
        "arguments",
        text("there is no scene '", scene, "', but grid, fem, block, hexahedra, hyperelastic and batch"));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> words;
  bool inDouble = false, understood = true;
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--double")
      inDouble = true;
    else if (word == "--steps" && more)
      o.steps = number(argv[++i], 1);
    else if (word == "--iterations" && more)
      o.iterations = number(argv[++i], 2);
    else if (word == "--blocks" && more)
      o.blocks.push_back(number(argv[++i], 0));
    else if (word == "--profile" && more)
      o.profile = argv[++i];
    else if (word == "--no-plain")
      o.plain = false;
    else if (word == "--no-fused")
      o.fused = false;
    else if (word == "--no-host")
      o.host = false;
    else if (word.starts_with("--"))
      understood = false;
    else
      words.push_back(word);
  }
  if (o.blocks.empty()) o.blocks = {0, 4, 16, 1000};
  const bool form =
      o.profile.empty() || o.profile == "plain" || o.profile == "assembled" || o.profile == "fused";
  if (words.empty() || !understood || !form) {
    std::fprintf(
        stderr,
        "usage: scenes grid NX NY NZ | fem FILE.msh | block CELLS | hexahedra CELLS | hyperelastic CELLS | "
        "batch FILE.msh|CELLS COPIES [--double] [--steps N] [--iterations N] [--no-host] [--no-plain] "
        "[--no-fused] [--blocks N]... [--profile plain|assembled|fused]\n");
    return 2;
  }
  if (inDouble)
    run<Vec3d>(words, o);
  else
    run<Vec3f>(words, o);
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "scenes: %s\n", error.what());
  return 1;
}
