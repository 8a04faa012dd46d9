// SPDX-License-Identifier: BSL-1.0
// Steps a second of the scenes of the table on a GPU, in all forms in turn: launched loop by loop, the step
// as a CUDA graph, the fused step.
//   scenes grid NX NY NZ | fem FILE.msh | block CELLS | hexahedra CELLS | hyperelastic CELLS
//          | batch FILE.msh COPIES
//          [--double] [--steps N] [--iterations N] [--no-host] [--no-plain] [--no-fused] [--blocks N]...
// Bodies of CELLS are unit cubes of so many cells along each edge.
// Prints, for each form: scene; points; elements; real; form; steps a second; how far point 100 is, over the
// largest coordinate, from where the processor has it after the first 50 steps.
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/gpu/fused/simulation.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/io/read_gmsh.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include "../../benchmarks/run/scenes.hpp"

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

// the median of five, of the seconds that a step takes
template <class Step>
double seconds_a_step(int steps, Step&& step) {
  std::vector<double> times;
  for (int round = 0; round < 5; ++round) {
    gpu::wait();
    const double start = now();
    step(steps);
    gpu::wait();
    times.push_back((now() - start) / steps);
  }
  std::sort(times.begin(), times.end());
  return times[2];
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
  // of a fused step, in turn; 0 is what it chooses, beyond 16 are all of a launch
  std::vector<int> blocks{};
  int copies = 0;
};

// make.template operator()<D>(linear) is the scene over D with that linear solver
template <class H, class Make>
void measure(Make const& make, Options const& o) {
  using Cuda = CudaTypes<H>;
  const auto plain = all_iterations<GraphScattered>(o.iterations);
  auto reference = make.template operator()<H>(plain);
  auto field = [](auto& sim) -> auto& {
    return *std::get<0>(components_that<gpu::detail::IsForceField>(components_of(sim.root())));
  };

  const double hostInit = now();
  reference.init();
  std::fprintf(stderr, "host init %.2f s\n", now() - hostInit);
  const auto points = reference.root().state().size(), elements = field(reference).driver.size();
  auto line = [&](std::string const& form, double seconds, double far) {
    std::printf("%s; %zu; %zu; %s; %s; %.1f; %.1e\n",
                o.scene.c_str(),
                points,
                elements,
                sizeof(typename H::Real) == 8 ? "double" : "float",
                form.c_str(),
                1 / seconds,
                far);
    std::fflush(stdout);
  };
  const bool small = elements < 200000;
  if (o.host) {
    const double start = now();
    const int steps = small ? compared : 2;
    for (int i = 0; i < steps; ++i) reference.animate(dt);
    line("processor, one thread, without lanes", (now() - start) / steps, 0);
  }
  const int same = small ? compared : 2;
  auto const& expected = reference.root().state().position;
  if (o.plain) {
    auto sim = make.template operator()<Cuda>(plain);
    const double start = now();
    sim.init();
    sim.animate(dt);
    gpu::wait();
    std::fprintf(stderr, "device init and first step %.2f s\n", now() - start);
    for (int i = 1; i < same; ++i) sim.animate(dt);
    const double far = o.host ? difference(std::as_const(sim.root().state().position), expected) : 0;
    line("launch by launch",
         seconds_a_step(o.steps,
                        [&](int n) {
                          for (int i = 0; i < n; ++i) sim.animate(dt);
                        }),
         far);
    // steps as graphs; of large bodies also what an iteration costs, from steps with fewer of them, and the
    // share of its time in which the matrix would be read once
    auto graph = [&](char const* form, auto linear) {
      double seconds[2];
      std::size_t bytes = 0;
      for (const int k : {0, 1}) {
        linear.iterations = k == 0 ? o.iterations : 5;
        if (k == 1 && small) break;
        auto recordedSim = make.template operator()<Cuda>(linear);
        recordedSim.init();
        gpu::RecordedStep recorded(recordedSim, dt);
        seconds[k] = seconds_a_step(o.steps, [&](int n) { recorded.animate(n); });
        bytes = linear.matrixFree ? field(recordedSim).driver.product.rows.bytes()
                                  : recordedSim.root().state().solverRoom.rows.bytes();
      }
      line(form, seconds[0], 0);
      if (small) return;
      const double each = (seconds[0] - seconds[1]) / (o.iterations - 5);
      std::printf(
          "%s; %zu; %zu; %s; %s; an iteration takes %.1f us, of which its product reads and writes %.1f MB: "
          "%.0f "
          "GB/s at least\n",
          o.scene.c_str(),
          points,
          elements,
          sizeof(typename H::Real) == 8 ? "double" : "float",
          form,
          each * 1e6,
          bytes / 1e6,
          bytes / each / 1e9);
    };
    using Matrix = std::conditional_t<sizeof(typename H::Real) == 8,
                                      CompressedRowSparseMatrixMat3x3d,
                                      CompressedRowSparseMatrixMat3x3f>;
    graph("graph", plain);
    graph("graph, assembled", all_iterations<Matrix>());
    graph("graph, assembled, block-Jacobi", ShewchukPCGLinearSolver<Matrix>{.tolerance = 0});
  }
  if (o.fused)
    for (const int blocks : o.blocks) {
      auto sim = make.template operator()<Cuda>(plain);
      sim.init();
      try {
        gpu::FusedSimulation fused(sim, 1, blocks);
        fused.animate(dt, same);
        fused.finish();
        fused.store(0, sim);
        const double far = o.host ? difference(std::as_const(sim.root().state().position), expected) : 0;
        const auto shape = fused.shape();
        line(text("fused, ",
                  shape.blocks,
                  " x ",
                  shape.threads,
                  blocks == 0 ? " (chosen)" : "",
                  ", one launch a step"),
             seconds_a_step(o.steps,
                            [&](int n) {
                              for (int i = 0; i < n; ++i) fused.animate(dt);
                            }),
             far);
        line(text("fused, ", shape.blocks, " x ", shape.threads, ", all steps in one launch"),
             seconds_a_step(o.steps, [&](int n) { fused.animate(dt, n); }),
             far);
        fused.finish();
      } catch (Error const& error) {
        std::fprintf(stderr, "%d blocks: %s\n", blocks, error.what());
      }
    }
}

// copies of one body with different stiffness
template <class H>
void batch(Mesh const& mesh, Options const& o) {
  using Cuda = CudaTypes<H>;
  auto sim = body<Cuda>(mesh, all_iterations<GraphScattered>());
  sim.init();
  auto softer = body<Cuda>(mesh, all_iterations<GraphScattered>(), 2500);
  softer.init();
  for (int copies = 1; copies <= o.copies; copies *= 4) {
    gpu::FusedSimulation fused(sim, copies);
    for (int c = 1; c < copies; c += 2) fused.load(c, softer);
    const int steps = std::max(2, o.steps / std::max(1, copies / 256));
    fused.animate(dt, 2);
    fused.finish();
    const double seconds = seconds_a_step(steps, [&](int n) { fused.animate(dt, n); });
    fused.finish();
    std::printf("batch %s; %zu; %zu; %s; %d copies, %d x %d; %.1f steps a second of all; %.0f of one\n",
                o.scene.c_str(),
                mesh.positions.size(),
                mesh.tetrahedra.size(),
                sizeof(typename H::Real) == 8 ? "double" : "float",
                copies,
                fused.shape().blocks,
                fused.shape().threads,
                1 / seconds,
                copies / seconds);
    std::fflush(stdout);
  }
}

template <class H>
void run(std::vector<std::string> const& words, Options o) {
  auto number = [&](std::size_t i) { return std::atoi(words.at(i).c_str()); };
  if (words.at(0) == "grid") {
    const std::array<int, 3> n{number(1), number(2), number(3)};
    o.scene = text("grid ", n[0], "x", n[1], "x", n[2]);
    measure<H>([&]<class D>(auto linear) { return spring_grid<D>(n, linear); }, o);
  } else if (words.at(0) == "hexahedra") {
    o.scene = "hexahedra";
    measure<H>([&]<class D>(auto linear) { return hexahedra<D>(number(1), linear); }, o);
  } else if (words.at(0) == "hyperelastic") {
    o.scene = "hyperelastic";
    measure<H>([&]<class D>(auto linear) { return hyperelastic<D>(block(number(1)), linear); }, o);
  } else if (words.at(0) == "batch") {
    o.scene = words.at(1).substr(words.at(1).find_last_of('/') + 1);
    o.copies = number(2);
    batch<H>(io::read_gmsh(words.at(1)), o);
  } else {
    const bool file = words.at(0) == "fem";
    const Mesh mesh = file ? io::read_gmsh(words.at(1)) : block(number(1));
    o.scene = file ? words.at(1).substr(words.at(1).find_last_of('/') + 1) : "block";
    measure<H>([&]<class D>(auto linear) { return body<D>(mesh, linear); }, o);
  }
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
    else if (word == "--steps" && i + 1 < argc)
      o.steps = std::atoi(argv[++i]);
    else if (word == "--iterations" && i + 1 < argc)
      o.iterations = std::atoi(argv[++i]);
    else if (word == "--blocks" && i + 1 < argc)
      o.blocks.push_back(std::atoi(argv[++i]));
    else if (word == "--no-plain")
      o.plain = false;
    else if (word == "--no-fused")
      o.fused = false;
    else if (word == "--no-host")
      o.host = false;
    else
      words.push_back(word);
  }
  if (o.blocks.empty()) o.blocks = {0, 4, 16, 1000};
  if (words.size() < 2) {
    std::fprintf(
        stderr,
        "usage: scenes grid NX NY NZ | fem FILE.msh | block CELLS | hexahedra CELLS | hyperelastic CELLS | "
        "batch FILE.msh COPIES [--double] [--steps N] [--iterations N] [--no-host] [--no-plain] [--no-fused] "
        "[--blocks N]...\n");
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
