// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a collision model collides with nothing: there is no DefaultPipeline above it
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Simulation sim{
      node<"root">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
