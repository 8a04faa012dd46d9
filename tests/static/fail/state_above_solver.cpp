// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a force field, mass, constraint or collision model acts on a state that the ODE solver above it does not move
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(MechanicalObject<Vec3d>{},
                              node<"solved">(EulerExplicitSolver{},
                                             node<"body">(MechanicalObject<Vec3d>{}),
                                             node<"other">(UniformMass<Vec3d>{})))};
  sim.init();
  sim.animate(0.1);
}
