// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a node has two children of the same name
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      EulerExplicitSolver{}, node<"a">(MechanicalObject<Vec3d>{}), node<"a">(MechanicalObject<Vec3d>{}))};
  sim.init();
  sim.animate(0.1);
}
