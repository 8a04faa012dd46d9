// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: no node has this path.
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      EulerExplicitSolver{}, node<"liver">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, node<"skin">()))};
  sim.init();
  sim.animate(0.1);
  sim.at<"liver/skin/edge">();
}
