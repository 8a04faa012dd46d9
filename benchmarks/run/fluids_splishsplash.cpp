// SPDX-License-Identifier: BSL-1.0
// The dam break of fluids.cpp, kind dfsph, by the DFSPH of SPlisHSPlasH: fluids_splishsplash SIZE SECONDS
// COUNT... As many particles, with the same distance, radius of the kernel, mass, steps, walls and limits of
// errors, and no viscosity. What differs: the kernel is a cubic spline, and where the library was built in
// single precision, its default, so is all. Prints lines as fluids does, and behind each what can be
// compared: steps, iterations for the density and for the divergence in the last step and in the mean, how
// far the front has come [m], the height of the centre [m], and the mean of what is compressed over the
// density at rest.
#include <SPlisHSPlasH/DFSPH/TimeStepDFSPH.h>
#include <SPlisHSPlasH/NonPressureForceBase.h>
#include <SPlisHSPlasH/Simulation.h>
#include <SPlisHSPlasH/TimeManager.h>
#include <Utilities/Counting.h>
#include <Utilities/Logger.h>
#include <Utilities/Timing.h>

#include "paired.hpp"

#include <omp.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

INIT_LOGGING
INIT_TIMING
INIT_COUNTING

namespace {

/// Planes as the PlaneForceField of fluids.cpp, with its damping.
class Walls : public SPH::NonPressureForceBase {
 public:
  struct Plane {
    Vector3r normal;
    Real d;
  };
  std::vector<Plane> planes{};
  Real stiffness{0}, damping{0};  // over the mass

  using NonPressureForceBase::NonPressureForceBase;
  std::string getMethodName() override { return "Walls"; }
  void step() override {
    const int count = int(m_model->numActiveParticles());
#pragma omp parallel for schedule(static)
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<unsigned>(k);
      for (Plane const& plane : planes) {
        const Real depth = plane.d - plane.normal.dot(m_model->getPosition(i));
        if (depth > 0)
          m_model->getAcceleration(i) +=
              depth * (stiffness * plane.normal - damping * m_model->getVelocity(i));
      }
    }
  }
};

struct Measured {
  double seconds = 0;
  int steps = 0, density = 0, divergence = 0;  // iterations of the last step
  double meanDensity = 0, meanDivergence = 0;  // the same of the steps that are timed
  double front = 0, height = 0, compressed = 0;
};

Measured measure(int n, double time, int steps, int threads) {
  using SPH::Simulation, SPH::TimeManager, SPH::TimeStepDFSPH;
  omp_set_num_threads(threads);
  const double distance = 1. / n, density = 1000, mass = density * std::pow(distance, 3);
  const double dt = 0.3 * distance / (2 * std::sqrt(9.81));

  Simulation& sim = *Simulation::getCurrent();
  TimeManager::getCurrent()->setTimeStepSize(Real(dt));
  sim.init(Real(distance / 2), false);  // the kernel has four times this radius
  sim.setBoundaryHandlingMethod(SPH::BoundaryHandlingMethods::Akinci2012);
  sim.addDragMethod("Walls",
                    [](SPH::FluidModel* model) -> SPH::NonPressureForceBase* { return new Walls(model); });

  std::vector<Vector3r> x;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        x.push_back(Real(distance) * Vector3r(Real(i + 0.5), Real(j + 0.5), Real(k + 0.5)));
  std::vector<Vector3r> v(x.size(), Vector3r::Zero());
  std::vector<unsigned> objects(x.size(), 0);
  const auto count = static_cast<unsigned>(x.size());
  sim.addFluidModel("water", count, x.data(), v.data(), objects.data(), 0);
  SPH::FluidModel& water = *sim.getFluidModel(0);
  water.setDensity0(Real(density));
  water.setViscosityMethod("None");
  water.setDragMethod("Walls");
  auto& walls = static_cast<Walls&>(*water.getDragBase());
  const auto half = Real(distance / 2);
  walls.planes = {
      {{0, 1, 0}, half}, {{1, 0, 0}, half}, {{-1, 0, 0}, -3}, {{0, 0, 1}, half}, {{0, 0, -1}, half - 1}};
  walls.stiffness = Real(0.2 / (dt * dt));
  walls.damping = Real(5 / mass);

  sim.setSimulationMethod(int(SPH::SimulationMethods::DFSPH));
  sim.setValue(Simulation::CFL_METHOD, Simulation::ENUM_CFL_NONE);
  auto& method = static_cast<TimeStepDFSPH&>(*sim.getTimeStep());
  method.setValue(TimeStepDFSPH::MAX_ERROR, Real(0.01));  // percent, as all of them
  method.setValue(TimeStepDFSPH::MAX_ERROR_V, Real(0.1));
  sim.setSimulationInitialized(true);

  // the volumes for which a lattice has the density at rest; the library takes 0.8 of those of cubes
  double around = 0;
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i)
        around += double(sim.W(Real(distance) * Vector3r(Real(i), Real(j), Real(k))));
  water.getVolume(0) = Real(1 / around);
  for (unsigned i = 0; i < count; ++i) water.setMass(i, Real(mass));

  Measured found;
  std::vector<double> times;
  double spent = 0;
  for (int i = 0; i < 20; ++i) method.step();
  for (int i = 0; steps > 0 ? i < steps : i < 3 || spent < time; ++i) {
    times.push_back(bench::seconds([&] { method.step(); }));
    spent += times.back();
    found.density = int(method.getValue<unsigned>(TimeStepDFSPH::SOLVER_ITERATIONS));
    found.divergence = int(method.getValue<unsigned>(TimeStepDFSPH::SOLVER_ITERATIONS_V));
    found.meanDensity += found.density;
    found.meanDivergence += found.divergence;
  }
  found.seconds = bench::median(times);
  found.steps = int(times.size());
  found.meanDensity /= found.steps;
  found.meanDivergence /= found.steps;
  sim.performNeighborhoodSearch();
  method.computeDensities(0);
  for (unsigned i = 0; i < count; ++i) {
    found.front = std::max(found.front, double(water.getPosition(i)[0]));
    found.height += double(water.getPosition(i)[1]) / count;
    found.compressed += std::max(0., double(water.getDensity(i)) / density - 1) / count;
  }
  delete &sim;
  if (!std::isfinite(found.height)) throw std::runtime_error("the particles have no finite positions");
  return found;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "usage: fluids_splishsplash SIZE SECONDS COUNT...\n");
    return 2;
  }
  const int n = std::max(2, int(std::lround(std::cbrt(std::atof(argv[1])))));
  int steps = 0;  // of the first count, and then of all
  for (int k = 3; k < argc; ++k) {
    const Measured m = measure(n, std::atof(argv[2]), steps, std::max(1, std::atoi(argv[k])));
    steps = m.steps;
    std::printf("splishsplash %d %s %.6g 1 %d 0\n", n * n * n, argv[k], m.seconds, m.density + m.divergence);
    std::printf(
        "# steps %d, iterations %d + %d, mean %.3g + %.3g, front %.6g, height %.6g, compressed %.3g\n",
        20 + m.steps,
        m.density,
        m.divergence,
        m.meanDensity,
        m.meanDivergence,
        m.front,
        m.height,
        m.compressed);
    std::fflush(stdout);
  }
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "fluids_splishsplash: %s\n", error.what());
  return 1;
}
