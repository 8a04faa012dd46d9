// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a MechanicalObject or VisualModel is the second state of its node
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, MechanicalObject<Vec3f>{})};
  sim.init();
  sim.animate(0.1);
}
