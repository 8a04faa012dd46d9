// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: the path of a node is a part of the call
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.at("root");
}
