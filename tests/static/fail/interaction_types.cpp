// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an interaction has other DataTypes than a state that it joins
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              node<"a">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                              node<"b">(MechanicalObject<Vec3f>{}),
                              StiffSpringForceField<Vec3d, Between<"a", "b">>{})};
  sim.init();
  sim.animate(0.1);
}
