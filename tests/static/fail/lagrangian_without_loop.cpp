// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a constraint by multipliers has no effect: the root has no animation loop that solves it
#include <sinew/lagrangian.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              FixedLagrangianConstraint<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
