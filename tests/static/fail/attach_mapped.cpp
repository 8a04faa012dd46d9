// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a projective constraint acts on a mapped state, which follows its parent
#include <sinew/constraint/attach.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   AttachProjectiveConstraint<Vec3d, Between<"a", "b/c">>{},
                   node<"a">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                   node<"b">(MechanicalObject<Vec3d>{},
                             UniformMass<Vec3d>{},
                             node<"c">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{})))};
  sim.init();
  sim.animate(0.1);
}
