// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an animation loop finds no constraint solver
#include <sinew/lagrangian.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      FreeMotionAnimationLoop{}, EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
