// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a Simulation is of a node
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{MechanicalObject<Vec3d>{}};
  sim.init();
}
