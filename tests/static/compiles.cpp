// SPDX-License-Identifier: BSL-1.0
// expect: nothing: this one compiles, and shows that the others fail for their mistake alone
#include <sinew/sinew.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   node<"liver">(MechanicalObject<Vec3d>{},
                                 UniformMass<Vec3d>{},
                                 FixedConstraint<Vec3d>{},
                                 node<"skin">(MechanicalObject<Vec3f>{}, IdentityMapping<Vec3d, Vec3f>{})),
                   node<"other">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                   StiffSpringForceField<Vec3d, Between<"liver", "other">>{})};
  sim.init();
  sim.animate(0.1);
  sim.at<"liver/skin">();
}
