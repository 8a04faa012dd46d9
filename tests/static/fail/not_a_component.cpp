// SPDX-License-Identifier: BSL-1.0
// expect: takes components and child nodes
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, 3)};
  sim.init();
  sim.animate(0.1);
}
