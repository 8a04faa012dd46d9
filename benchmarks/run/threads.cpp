// SPDX-License-Identifier: BSL-1.0
// Steps of one corotational body by several threads: threads CELLS SECONDS COUNT..., for a cube of CELLS^3
// cells, six tetrahedra each. Prints one line a kind and count: kind, tetrahedra, threads, seconds a step of
// 25 conjugate-gradient iterations (the median of steps that take about so many seconds), and a number made
// of all bits of positions and velocities after the same number of steps for all counts, which has to be the
// same.
#include "bodies.hpp"

#include <cstdint>
#include <cstring>
#include <string>

using namespace bench;

namespace {

/// FNV-1a over the bytes of positions and velocities.
template <class State>
std::uint64_t fingerprint(State const& state) {
  std::uint64_t hash = 1469598103934665603u;
  auto add = [&](auto const& list) {
    auto const* bytes = reinterpret_cast<unsigned char const*>(list.data());
    for (std::size_t i = 0; i < list.size() * sizeof list[0]; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  };
  add(state.position);
  add(state.velocity);
  return hash;
}

/// Has a scene that is initialised work with so many threads.
template <class Sim>
void use(Sim& sim, int count) {
  auto& threads = sim.root().template get<Threads>();
  threads.count = count;
  threads.init();
  const NoScope above;
  const typename Sim::RootScope scope{sim.root(), above};
  MechanicalOperations operations(scope);
  auto& linear = sim.root().template first<role::LinearSolver>();
  if constexpr (requires { linear.system.matrix; }) linear.system.matrix.split(count);
  operations.split();
  operations.reserveSums(3 * sim.root().state().size());
}

template <class D, class Matrix>
void measure(char const* kind, Mesh const& mesh, double time, std::vector<int> const& counts) {
  auto sim = solved_body<D>(mesh, corotational<D>(), Threads{}, damped_euler(), all_iterations<Matrix>());
  sim.init();
  int steps = 0;
  for (const int count : counts) {
    use(sim, count);
    sim.reset();
    sim.animate(0.02);
    const double second = seconds([&] { sim.animate(0.02); });
    if (steps == 0) steps = std::max(3, int(time / second));
    std::vector<double> times;
    for (int i = 0; i < steps; ++i) times.push_back(seconds([&] { sim.animate(0.02); }));
    std::printf("%s %zu %d %.6g %016llx\n",
                kind,
                mesh.tetrahedra.size(),
                count,
                median(times),
                static_cast<unsigned long long>(fingerprint(sim.root().state())));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "usage: threads CELLS SECONDS COUNT...\n");
    return 2;
  }
  const int cells = whole_number(argv[1]);
  if (cells < 4 || cells > 200) throw Error("arguments", "CELLS is 4 to 200");
  const double time = std::atof(argv[2]);
  std::vector<int> counts;
  for (int i = 3; i < argc; ++i) counts.push_back(whole_number(argv[i]));
  const Mesh mesh = block(cells);
  measure<Vec3d, CompressedRowSparseMatrixMat3x3d>("assembled", mesh, time, counts);
  measure<Vec3d, GraphScattered>("matrix-free", mesh, time, counts);
  measure<Vec3f, CompressedRowSparseMatrixMat3x3f>("assembled,float", mesh, time, counts);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "threads: %s\n", error.what());
  return 1;
}
