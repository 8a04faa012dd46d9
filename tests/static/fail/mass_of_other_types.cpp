// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component has other DataTypes than the state on which it acts
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Rigid3d>{})};
  sim.init();
  sim.animate(0.1);
}
