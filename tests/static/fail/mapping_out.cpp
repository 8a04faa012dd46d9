// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping maps to other DataTypes than those of its child
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              node<"a">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3f>{}))};
  sim.init();
  sim.animate(0.1);
}
