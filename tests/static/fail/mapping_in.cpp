// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: the In of a mapping differs
#include <sinew/sinew.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              node<"a">(MechanicalObject<Vec3d>{}, RigidMapping<Rigid3d, Vec3d>{}))};
  sim.init();
  sim.animate(0.1);
}
