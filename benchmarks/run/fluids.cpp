// SPDX-License-Identifier: BSL-1.0
// Steps of fluids by several threads: fluids KIND SIZE SECONDS COUNT..., KIND one of sph, sphf (in float),
// dfsph and grid. A dam breaks: a block of SIZE particles, which rests on the floor of a tank of three times
// its length, or a third of SIZE^3 cells. Prints one line a count: kind, particles or cells, threads, seconds
// a step (the median of those that take about so many seconds, behind the first 20), substeps or 1,
// iterations for the pressure of the last step or 0, and a number made of all bits of positions, the same for
// all counts.
#include <sinew/control/threads.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

#include "paired.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

using namespace sinew;

namespace {

template <class List>
std::uint64_t fingerprint(List const& list) {
  std::uint64_t hash = 1469598103934665603u;
  auto const* bytes = reinterpret_cast<unsigned char const*>(list.data());
  for (std::size_t i = 0; i < list.size() * sizeof list[0]; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

struct Measured {
  std::size_t parts = 0;  // particles or cells
  double seconds = 0;
  int steps = 0, substeps = 1, iterations = 0;
  std::uint64_t bits = 0;
};

/// Times steps of dt behind the first 20: so many, or, where that is 0, for some time.
template <class Sim>
void time_steps(Sim& sim, double dt, double time, int steps, Measured& found) {
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(dt);
  std::vector<double> times;
  double spent = 0;
  for (int i = 0; steps > 0 ? i < steps : i < 3 || spent < time; ++i) {
    times.push_back(bench::seconds([&] { sim.animate(dt); }));
    spent += times.back();
  }
  found.seconds = bench::median(times);
  found.steps = int(times.size());
}

// a block of 1 x 1 x 1 m by particles of about the distance that gives so many
std::vector<Eigen::Vector3d> block(int particles, double& distance) {
  const int n = std::max(2, int(std::lround(std::cbrt(double(particles)))));
  distance = 1. / n;
  std::vector<Eigen::Vector3d> x;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) x.push_back(distance * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
  return x;
}

template <class D, class Solver, class... Forces>
auto tank(Solver solver, std::vector<Eigen::Vector3d> const& x, double distance, double mass,
          double stiffness, int threads, Forces... forces) {
  using Wall = PlaneForceField<D>;
  using Real = typename D::Real;
  typename D::VecCoord positions;
  for (auto const& p : x) positions.push_back(p.cast<Real>());
  return Simulation{
      node<"root">(Threads{.count = threads},
                   Gravity{{0, -9.81, 0}},
                   node<"water">(solver,
                                 MechanicalObject<D>{positions},
                                 UniformMass<D>{.vertexMass = mass},
                                 forces...,
                                 Wall{.normal = {0, 1, 0}, .d = distance / 2, .stiffness = stiffness},
                                 Wall{.normal = {1, 0, 0}, .d = distance / 2, .stiffness = stiffness},
                                 Wall{.normal = {-1, 0, 0}, .d = -3, .stiffness = stiffness},
                                 Wall{.normal = {0, 0, 1}, .d = distance / 2, .stiffness = stiffness},
                                 Wall{.normal = {0, 0, -1}, .d = distance / 2 - 1, .stiffness = stiffness}))};
}

Measured measure(std::string const& kind, int size, double time, int steps, int threads) {
  Measured found;
  double d = 1;
  if (kind == "grid") {
    const int n = size;
    found.parts = std::size_t(n) * std::size_t(n) * std::size_t(n);
    // a third of the tank is full at the start, to its end
    Simulation sim{node<"root">(Threads{.count = threads},
                                Gravity{{0, -9.81, 0}},
                                node<"water">(Fluid3D<Vec3d>{.nx = n + 2,
                                                             .ny = n + 2,
                                                             .nz = n + 2,
                                                             .cellwidth = 1. / n,
                                                             .height = n / 3.,
                                                             .dir = {1, 0.3, 0}}))};
    time_steps(sim, 0.5 / n / 3, time, steps, found);
    auto const& fluid = sim.template at<"water">().template get<Fluid3D<Vec3d>>();
    const Mesh border = fluid.border();
    found.bits = fingerprint(border.positions);
    return found;
  }
  const std::vector<Eigen::Vector3d> x = block(size, d);
  found.parts = x.size();
  const double density = 1000, mass = density * d * d * d;
  if (kind == "sph" || kind == "sphf") {
    auto run = [&]<class D>(D) {
      // the speed of sound is ten times that of the front, 2 sqrt(g h)
      const double sound = 10 * 2 * std::sqrt(9.81), dt = 0.2 * 2 * d / sound;
      auto sim = tank<D>(EulerExplicitSolver{.symplectic = true},
                         x,
                         d,
                         mass,
                         mass * std::pow(sound / (2 * d), 2),
                         threads,
                         SPHFluidForceField<D>{.radius = 2 * d,
                                               .mass = mass,
                                               .pressure = sound * sound,
                                               .density = density,
                                               .viscosity = 1,
                                               .kernelType = 1,
                                               .viscosityType = 2});
      time_steps(sim, dt, time, steps, found);
      found.bits = fingerprint(sim.template at<"water">().state().position);
    };
    kind == "sph" ? run(Vec3d{}) : run(Vec3f{});
  } else {
    const double dt = 0.3 * d / (2 * std::sqrt(9.81));
    auto sim = tank<Vec3d>(
        DFSPHSolver{.radius = 2 * d, .density = density}, x, d, mass, 0.2 * mass / (dt * dt), threads);
    time_steps(sim, dt, time, steps, found);
    auto const& solver = sim.template at<"water">().template get<DFSPHSolver>();
    found.substeps = solver.substeps;
    found.iterations = solver.ofDensity.taken + solver.ofDivergence.taken;
    found.bits = fingerprint(sim.template at<"water">().state().position);
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string kind = argc > 1 ? argv[1] : "";
  if (argc < 5 || (kind != "sph" && kind != "sphf" && kind != "dfsph" && kind != "grid")) {
    std::fprintf(stderr, "usage: fluids sph|sphf|dfsph|grid SIZE SECONDS COUNT...\n");
    return 2;
  }
  const int size = std::atoi(argv[2]);
  const double time = std::atof(argv[3]);
  if (size < 8 || size > 8'000'000) throw Error("arguments", "SIZE is 8 to 8000000");
  int steps = 0;  // of the first count, and then of all
  for (int k = 4; k < argc; ++k) {
    const int threads = std::atoi(argv[k]);
    if (threads < 1 || threads > 1000) throw Error("arguments", "COUNT is 1 to 1000");
    const Measured m = measure(kind, size, time, steps, threads);
    steps = m.steps;
    std::printf("%s %zu %d %.6g %d %d %016llx\n",
                kind.c_str(),
                m.parts,
                threads,
                m.seconds,
                m.substeps,
                m.iterations,
                static_cast<unsigned long long>(m.bits));
    std::fflush(stdout);
  }
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "fluids: %s\n", error.what());
  return 1;
}
