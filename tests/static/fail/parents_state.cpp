// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping follows a node that has no MechanicalObject
#include <sinew/context/gravity.hpp>
#include <sinew/mapping/subset_multi_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      node<"a">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
      node<"b">(Gravity{}),
      node<"c">(MechanicalObject<Vec3d>{}, SubsetMultiMapping<Vec3d, Vec3d, Parents<"../a", "../b">>{}))};
  sim.init();
  sim.animate(0.1);
}
