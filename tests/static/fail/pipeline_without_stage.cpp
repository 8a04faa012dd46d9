// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: collision detection needs one of each stage in its node
#include <sinew/sinew.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(DefaultPipeline{},
                              BruteForceBroadPhase{},
                              MinProximityIntersection{},
                              DefaultContactManager{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
