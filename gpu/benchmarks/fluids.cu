// SPDX-License-Identifier: BSL-1.0
// Steps a second on a GPU of a dam that breaks, of particles (SPHFluidForceField) or in a cube of n^3 cells
// (Fluid3D), the scenes of benchmarks/run/fluids.cpp:
//   fluids PARTICLES [--double] [--steps N] [--graph] [--host]
//   fluids grid N [--double] [--steps N] [--host]                (grid_fluids.hpp)
// A block of 1 m^3 rests on the floor of a tank of three times its length. Prints particles; real; steps a
// second, the median of N steps (200) behind the first 20, by the clock of the host, which waits for each, or
// their mean with --graph (RecordedStep), where it waits for the last; us a step and particle. --host prints
// how far particles are from where the processor has them after 20 steps, in distances of particles.
#include "grid_fluids.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/gpu/recorded_step.hpp>

#include <sinew/context/gravity.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/sph_fluid.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace sinew;

namespace {

struct Options {
  int particles = 0, cells = 0, steps = 200;  // cells: along each axis of a grid
  bool inDouble = false, graph = false, host = false, grid = false;
};

constexpr double density = 1000;
constexpr int settling = 20;

struct Dam {
  double distance, mass, sound, dt;
  std::vector<Eigen::Vector3d> x{};

  explicit Dam(int particles) {
    const int n = std::max(2, int(std::lround(std::cbrt(double(particles)))));
    distance = 1. / n;
    mass = density * distance * distance * distance;
    sound = 20 * std::sqrt(9.81);  // ten times the speed of the front
    dt = 0.2 * 2 * distance / sound;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) x.push_back(distance * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
  }
};

template <class D>
auto scene(Dam const& dam) {
  using Wall = PlaneForceField<D>;
  std::vector<typename D::Coord> x;
  for (auto const& p : dam.x) x.push_back(p.template cast<typename D::Real>());
  const double near = dam.distance / 2, stiffness = dam.mass * std::pow(dam.sound / (2 * dam.distance), 2);
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   node<"water">(EulerExplicitSolver{.symplectic = true},
                                 MechanicalObject<D>{x},
                                 UniformMass<D>{.vertexMass = dam.mass},
                                 SPHFluidForceField<D>{.radius = 2 * dam.distance,
                                                       .mass = dam.mass,
                                                       .pressure = dam.sound * dam.sound,
                                                       .density = density,
                                                       .viscosity = 1,
                                                       .kernelType = 1,
                                                       .viscosityType = 2},
                                 Wall{.normal = {0, 1, 0}, .d = near, .stiffness = stiffness},
                                 Wall{.normal = {1, 0, 0}, .d = near, .stiffness = stiffness},
                                 Wall{.normal = {-1, 0, 0}, .d = -3, .stiffness = stiffness},
                                 Wall{.normal = {0, 0, 1}, .d = near, .stiffness = stiffness},
                                 Wall{.normal = {0, 0, -1}, .d = near - 1, .stiffness = stiffness}))};
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class D>
void measure(Options const& o) {
  const Dam dam(o.particles);
  auto sim = scene<D>(dam);
  sim.init();
  for (int i = 0; i < settling; ++i) sim.animate(dam.dt);
  gpu::wait();
  if (o.host) {
    auto same = scene<typename D::Host>(dam);
    same.init();
    for (int i = 0; i < settling; ++i) same.animate(dam.dt);
    auto const& a = sim.template at<"water">().state().position;
    auto const& b = same.template at<"water">().state().position;
    double apart = 0;
    for (std::size_t i = 0; i < dam.x.size(); ++i)
      apart = std::max(apart, double((a[i] - b[i]).norm()) / dam.distance);
    std::printf("after %d steps %.1e of a distance from the processor's\n", settling, apart);
  }
  double seconds = 0;
  if (o.graph) {
    gpu::RecordedStep step(sim, dam.dt);
    step.animate();
    step.finish();
    const double began = now();
    step.animate(o.steps);
    step.finish();
    seconds = (now() - began) / o.steps;
  } else {
    std::vector<double> times;
    for (int i = 0; i < o.steps; ++i) {
      const double began = now();
      sim.animate(dam.dt);
      gpu::wait();
      times.push_back(now() - began);
    }
    std::nth_element(times.begin(), times.begin() + o.steps / 2, times.end());
    seconds = times[std::size_t(o.steps) / 2];
  }
  double front = 0;
  for (auto const& p : sim.template at<"water">().state().position) front = std::max(front, double(p[0]));
  std::printf("%zu; %s; %s; %.1f; %.5f; front at %.3f m after %.3f s\n",
              dam.x.size(),
              sizeof(typename D::Real) == 4 ? "float" : "double",
              o.graph ? "graph" : "launches",
              1 / seconds,
              1e6 * seconds / double(dam.x.size()),
              front,
              sim.time());
}

int whole_number(std::string const& text, int least, int most) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (end == text.c_str() || *end || value < least || value > most)
    throw Error("arguments", sinew::text("'", text, "' is not a whole number from ", least, " to ", most));
  return int(value);
}

}  // namespace

int main(int argc, char** argv) try {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--double")
      o.inDouble = true;
    else if (word == "--graph")
      o.graph = true;
    else if (word == "--host")
      o.host = true;
    else if (word == "grid" && i == 1)
      o.grid = true;
    else if (word == "--steps" && i + 1 < argc)
      o.steps = whole_number(argv[++i], 1, 1'000'000);
    else if (o.grid && o.cells == 0)
      o.cells = whole_number(word, 4, 1000);
    else if (!o.grid && o.particles == 0)
      o.particles = whole_number(word, 8, 100'000'000);
    else
      throw Error("arguments",
                  sinew::text("'", word, "' is no option; there are --double, --steps, --graph and --host"));
  }
  if (o.particles == 0 && o.cells == 0) {
    std::fprintf(stderr, "usage: gpu_fluids PARTICLES|grid N [--double] [--steps N] [--graph] [--host]\n");
    return 2;
  }
  if (o.grid) {
    if (o.graph) throw Error("arguments", "the step of a fluid on a grid is not recorded as a graph");
    o.inDouble ? grid_fluids::measure<CudaVec3d>(o.cells, o.steps, settling, o.host)
               : grid_fluids::measure<CudaVec3f>(o.cells, o.steps, settling, o.host);
    return 0;
  }
  o.inDouble ? measure<CudaVec3d>(o) : measure<CudaVec3f>(o);
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "gpu_fluids: %s\n", error.what());
  return 1;
}
