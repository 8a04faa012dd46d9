// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: this node has no component of the class asked for
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.root().get<UniformMass<Vec3f>>();
}
