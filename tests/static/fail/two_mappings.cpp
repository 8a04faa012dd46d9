// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping is the second mapping of its node
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{},
      UniformMass<Vec3d>{},
      node<"a">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{}, SubsetMapping<Vec3d, Vec3d>{}))};
  sim.init();
  sim.animate(0.1);
}
