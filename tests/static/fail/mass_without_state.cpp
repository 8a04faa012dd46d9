// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a force field, mass, constraint or collision model has no state to act on
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
