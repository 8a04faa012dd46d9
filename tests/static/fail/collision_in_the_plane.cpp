// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: collision models are in space
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(MechanicalObject<Vec2d>{}, UniformMass<Vec2d>{}, SphereCollisionModel<Vec2d>{})};
  sim.init();
}
