// SPDX-License-Identifier: BSL-1.0
// Seconds to |b - A x| = 1e-6 |b| over one assembled matrix on a GPU, by multigrid and by conjugate gradients
// with diagonal blocks: multigrid CELLS... [--float] [--threads N] [--whole POINTS] [--no-jacobi], of unit
// cubes of CELLS^3 cells of six tetrahedra, held at three points, in the third step with implicit Euler;
// --whole: solves of bodies of so many points are one kernel (0: of none). Prints a line a solver:
// tetrahedra; points; real; solver; milliseconds of the first set-up with the patterns, of a later one, of
// the solution; iterations; residual; levels; of a whole step.
#include <sinew/gpu/gpu.hpp>

#include <sinew/control/threads.hpp>
#include <sinew/solver/multigrid_linear_solver.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>

#include "../../benchmarks/run/scenes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

using namespace bench;

namespace {

double now() {
  gpu::wait();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// A solver whose parts are timed while `measured`.
template <class Linear>
struct Timed : Linear {
  bool measured = false;
  double setUp = 0, first = 0, solution = 0;

  static constexpr bool ofMultigrid = requires(Linear l) { l.onStates; };

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& x,
             MultiVecDeriv<Operations>& b) {
    const bool begins = this->age < 0;
    const double before = now();
    Linear::solve(operations, factors, x, b);
    if (begins) first = now() - before;
    if (!measured) return;
    std::vector<double> assembly, alone, whole;
    for (int i = 0; i < 5; ++i) {
      double t = now();
      {
        MultiVecDeriv p(operations), q(operations);
        gpu::assemble_on_device(operations, factors, p, q);
      }
      assembly.push_back(now() - t);
      this->age = ofMultigrid ? -1 : 1;
      t = now();
      Linear::solve(operations, factors, x, b);
      whole.push_back(now() - t);
      this->age = 1;
      t = now();
      Linear::solveAgain(operations, x, b);
      alone.push_back(now() - t);
    }
    this->age = 0;
    solution = median(alone) - (ofMultigrid ? 0 : median(assembly));
    setUp = median(whole) - median(alone) - (ofMultigrid ? median(assembly) : 0);
  }
};

template <class D, class Linear>
void measure(Mesh const& mesh, char const* name, Linear linear, int threads) {
  using Solver = Timed<Linear>;
  const Solver timed{linear};
  const double start = now();
  auto sim = solved_body<D>(mesh, corotational<D>(), Threads{threads}, damped_euler(), timed);
  sim.init();
  const double initialised = now() - start;
  Solver& solver = sim.root().template get<Solver>();
  sim.animate(0.02);
  sim.animate(0.02);
  std::vector<double> steps;
  solver.measured = true;
  sim.animate(0.02);
  solver.measured = false;
  int iterations = 0, levels = 0;
  double residual = 0;
  if constexpr (Solver::ofMultigrid) {
    iterations = int(solver.residuals.size()) - 1;
    residual = solver.residuals.back();
    levels = sim.root().state().solverWorkspace.multigrid.cycle.levels();
    for (const int n : sim.root().state().solverWorkspace.multigrid.cycle.sizes())
      std::printf("# level of %d\n", n);
    for (const double r : solver.residuals) std::printf("# %.3g\n", r);
  } else {
    auto const& sizes = std::as_const(sim.root().state().solverWorkspace.numbers).host();
    while (iterations < linear.iterations &&
           sizes[std::size_t(iterations)] > linear.tolerance * linear.tolerance * sizes[0])
      ++iterations;
    residual = std::sqrt(sizes[std::size_t(iterations)] / sizes[0]);
  }
  for (int i = 0; i < 5; ++i) {
    const double t = now();
    sim.animate(0.02);
    steps.push_back(now() - t);
  }
  std::printf("%zu; %zu; %s; %s; %.1f; %.3f; %.3f; %d; %.2g; %d; %.3f; # scene made in %.0f ms\n",
              mesh.tetrahedra.size(),
              mesh.positions.size(),
              sizeof(typename D::Real) == 8 ? "double" : "float",
              name,
              solver.first,
              solver.setUp,
              solver.solution,
              iterations,
              residual,
              levels,
              median(steps),
              initialised);
  std::fflush(stdout);
}

template <class D>
void measure(int cells, int threads, bool jacobi) {
  const Mesh mesh = block(cells);
  measure<D>(mesh, "multigrid", MultigridLinearSolver<>{}, threads);
  if (!jacobi) return;
  measure<D>(mesh,
             "block Jacobi",
             ShewchukPCGLinearSolver<CompressedRowSparseMatrixMat3x3d>{
                 .iterations = 4000, .tolerance = 1e-6, .precondition = PreconditionerMethod::blockJacobi},
             threads);
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<int> cells;
  int threads = 1;
  bool single = false, jacobi = true;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = arguments[i];
    if (word == "--float")
      single = true;
    else if (word == "--no-jacobi")
      jacobi = false;
    else if (word == "--whole" && i + 1 < count)
      gpu::most_points_of_whole_multigrid() = std::size_t(std::atoi(arguments[++i]));
    else if (word == "--threads" && i + 1 < count)
      threads = std::atoi(arguments[++i]);
    else
      cells.push_back(std::atoi(arguments[i]));
  }
  for (const int n : cells)
    if (single)
      measure<CudaVec3f>(n, threads, jacobi);
    else
      measure<CudaVec3d>(n, threads, jacobi);
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "multigrid: %s\n", error.what());
  return 1;
}
