// SPDX-License-Identifier: BSL-1.0
// Time and memory of one corotational body, assembled: growth CELLS, for a cube of CELLS^3 cells, six
// tetrahedra each. Prints one line: tetrahedra, points, seconds a step of 25 conjugate-gradient iterations,
// seconds an iteration, and bytes: that the process has more after init than before the mesh, at most in
// between, of the arrays that a step goes through, and that the method needs at least.
//
// Of a step: the matrix with its copy in slices and the places of its blocks, the packs of elements, five
// vectors of the solver and nine of the body (x, v, f, dv, b, two of Newton's method, rest and mass). At
// least: the half of a symmetric matrix with a column for each block, for each element the numbers of its
// points, three gradients and two moduli, and x, v, f, dv, b, r, p, q and the mass.
#include "bodies.hpp"

#include <sinew/topology/adjacency.hpp>

#include <fstream>
#include <string>

using namespace bench;

namespace {

/// A line of what Linux says of this process, in bytes: VmRSS, what it has now, or VmHWM, the most it had.
double of_process(std::string const& name) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.rfind(name + ":", 0) == 0) return 1024 * std::atof(line.c_str() + name.size() + 1);
  throw Error("/proc/self/status", "there is no line " + name + "; memory is measured on Linux only");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: growth CELLS\n");
    return 2;
  }
  const int cells = whole_number(argv[1]);
  if (cells < 4 || cells > 200) throw Error("arguments", "CELLS is 4 to 200");
  const double before = of_process("VmRSS");
  auto sim = body<Vec3d>(block(cells), all_iterations<CompressedRowSparseMatrixMat3x3d>());
  sim.init();
  const double after = of_process("VmRSS") - before, maximum = of_process("VmHWM") - before;

  auto& solver = sim.root().first<role::LinearSolver>();
  auto const& driver = sim.root().first<role::ForceField>().driver;
  const double points = double(sim.root().state().size()), tetrahedra = double(driver.size());
  const double edges = double(edges_of(sim.root().first<role::Topology>().tetrahedra).size());
  auto bytes = [](auto const& list) { return double(list.size() * sizeof list[0]); };
  const double arrays =
      double(solver.system.matrix.bytes()) + bytes(driver.packs) + bytes(driver.slots) + 14 * 24 * points;
  const double minimum = 76 * (points + edges) + (16 + 72 + 16) * tetrahedra + (8 * 24 + 8) * points;

  // an iteration is the difference of many and few
  constexpr int many = 25, few = 5;
  auto step = [&](int iterations) {
    solver.iterations = iterations;
    const int steps = std::max(1, int(0.2 / seconds_a_step(sim, 1)));
    return seconds_a_step(sim, steps);
  };
  std::vector<double> long_steps, iterations;
  for (int r = 0; r < 5; ++r) {
    long_steps.push_back(step(many));
    iterations.push_back((long_steps.back() - step(few)) / (many - few));
  }
  std::printf("%.0f %.0f %.6g %.6g %.0f %.0f %.0f %.0f\n",
              tetrahedra,
              points,
              median(long_steps),
              median(iterations),
              after,
              maximum,
              arrays,
              minimum);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "growth: %s\n", error.what());
  return 1;
}
