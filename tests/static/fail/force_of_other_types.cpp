// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component and the MechanicalObject it acts on have different DataTypes.
#include <sinew/sinew.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              StiffSpringForceField<Vec3f>{})};
  sim.init();
  sim.animate(0.1);
}
