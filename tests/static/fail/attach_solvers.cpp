// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a constraint joins bodies under different ODE solvers
#include <sinew/constraint/attach.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(AttachProjectiveConstraint<Vec3d, Between<"a", "b">>{},
                   node<"a">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                   node<"b">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}))};
  sim.init();
  sim.animate(0.1);
}
