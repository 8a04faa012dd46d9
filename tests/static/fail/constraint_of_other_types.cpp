// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component has other DataTypes than the state on which it acts
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, FixedConstraint<Vec2d>{})};
  sim.init();
  sim.animate(0.1);
}
