// SPDX-License-Identifier: BSL-1.0
// How near to what the processor can do the three loops of a step come: roofline CELLS ROUNDS, for a cube of
// CELLS^3 cells, six tetrahedra each. First line: peak, of one thread [flops/s]. Then one line a loop: name,
// seconds, flops, bytes, and bytes/s of a triad a = b + s c over as many bytes.
//
// Flops are the operations of the law as it is written (Counted), for each tetrahedron, and 2 for each entry
// of the matrix that a product takes. Bytes are those of every array that is read, once, and of every array
// that is written, twice: a line of memory is fetched before it is written. So the triad counts four times
// its length too.
#include "bodies.hpp"
#include "law_flops.hpp"

#include <sinew/topology/adjacency.hpp>

#include <functional>

using namespace bench;

namespace {

// kept from the optimiser
volatile double sink = 0;

double triad(std::size_t bytes, double minimum) {
  const std::size_t n = std::max<std::size_t>(bytes / (3 * sizeof(double)), 64);
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  double* const pa = a.data();
  double const *const pb = b.data(), *const pc = c.data();
  long passes = 0;
  double time = 0;
  while (time < minimum) {
    const long some = std::max<long>(1, long(4'000'000 / n));
    time += processor_seconds([&] {
      for (long k = 0; k < some; ++k) {
        const double s = 1e-9 * double(k);
        for (std::size_t i = 0; i < n; ++i) pa[i] = pb[i] + s * pc[i];
        asm volatile("" : : "r"(pa) : "memory");
      }
    });
    passes += some;
  }
  sink = a[n / 2];
  return 4.0 * sizeof(double) * double(n) * double(passes) / time;
}

/// Multiplications and additions a second, of as many independent sums as hide what one takes.
double peak() {
  using L = lanes<double>;
  constexpr int sums = 16, width = native_width<double>;
  double best = 0;
  for (int trial = 0; trial < 9; ++trial) {
    L s[sums];
    for (int k = 0; k < sums; ++k) s[k] = L(1.0 + k);
    const L a(0.999999), b(1e-6);
    constexpr long loops = 4'000'000;
    const double time = processor_seconds([&] {
      for (long i = 0; i < loops; ++i)
#pragma GCC unroll 16
        for (int k = 0; k < sums; ++k) s[k] = s[k] * a + b;
    });
    for (int k = 0; k < sums; ++k) sink = sink + lane(s[k], 0);
    best = std::max(best, 2.0 * sums * width * loops / time);
  }
  return best;
}

struct Loop {
  char const* name;
  double flops, bytes;
  std::function<void()> run;
  std::vector<double> times{}, bandwidths{};
};

template <class T>
double bytes_of(std::vector<T> const& list) {
  return double(list.size() * sizeof(T));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: roofline CELLS ROUNDS\n");
    return 2;
  }
  const int cells = whole_number(argv[1]), rounds = whole_number(argv[2]);
  if (cells < 4 || cells > 200) throw Error("arguments", "CELLS is 4 to 200");
  const Mesh mesh = block(cells);
  const double points = double(mesh.positions.size()), tetrahedra = double(mesh.tetrahedra.size());
  const double blocks = points + 2 * double(edges_of(mesh.tetrahedra).size());

  using Matrix = CompressedRowSparseMatrixMat3x3d;
  auto sim = body<Vec3d>(mesh, all_iterations<Matrix>(2));
  sim.init();
  sim.animate(0.02);
  const NoScope above;
  const typename decltype(sim)::RootScope scope{sim.root(), above};
  MechanicalOperations operations(scope);
  auto& system = sim.root().first<role::LinearSolver>().system;
  auto& force = sim.root().first<role::ForceField>();
  auto& state = sim.root().state();
  auto& driver = force.driver;
  const MechanicalParams p{.dt = 0.02, .k = -0.0024};

  const double vector = 24 * points, packs = bytes_of(driver.packs), slots = bytes_of(driver.slots);
  const double tangents = double(driver.packs.size() * sizeof driver.packs[0].tangent);
  Matrix const& m = system.matrix;
  const double values = bytes_of(m.values);
  const LawFlops law = tetrahedron_flops();
  std::vector<Loop> loops;
  auto multiply = [&] { system.matrix.multiply(system.p.data(), system.q.data()); };
  for (int i = 0; i < 4; ++i) multiply();  // from the fourth on large matrices take slices
  loops.push_back({"matrix-vector", 18 * blocks, double(m.productBytes()) + 3 * vector, multiply});
  loops.push_back({"force", law.force * tetrahedra, packs + tangents + 3 * vector, [&] {
                     add_force(force, p, state.force, state.position, state.velocity);
                   }});
  loops.push_back({"matrix-free-product", law.dforce * tetrahedra, packs + 3 * vector, [&] {
                     add_dforce(force, p, state.force, state.velocity);
                   }});
  loops.push_back({"assembly", law.blocks * tetrahedra, packs + slots + 2 * values, [&] {
                     operations.assemble(system.matrix, {.m = 1, .k = -0.0024});
                   }});
  double top = 0;
  for (int r = 0; r < rounds; ++r) {
    top = std::max(top, peak());
    for (Loop& loop : loops) {
      const int times = std::max(1, int(0.1 / processor_seconds(loop.run)));
      loop.times.push_back(processor_seconds([&] {
                             for (int i = 0; i < times; ++i) loop.run();
                           }) /
                           times);
      loop.bandwidths.push_back(triad(std::size_t(loop.bytes), 0.05));
    }
  }
  std::printf("peak %.6g\n", top);
  for (Loop const& loop : loops)
    std::printf("%s %.6g %.6g %.6g %.6g\n",
                loop.name,
                median(loop.times),
                loop.flops,
                loop.bytes,
                median(loop.bandwidths));
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "roofline: %s\n", error.what());
  return 1;
}
