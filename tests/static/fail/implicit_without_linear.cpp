// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a solver is implicit and finds no linear solver
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerImplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
