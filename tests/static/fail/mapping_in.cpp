// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping maps from other DataTypes than those of its parent
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              node<"a">(MechanicalObject<Vec3d>{}, RigidMapping<Rigid3d, Vec3d>{}))};
  sim.init();
  sim.animate(0.1);
}
