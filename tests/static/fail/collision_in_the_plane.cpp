// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: collision models are in space
#include <sinew/sinew.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(MechanicalObject<Vec2d>{}, UniformMass<Vec2d>{}, SphereCollisionModel<Vec2d>{})};
  sim.init();
}
