// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: collision detection needs one of each stage in its node
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

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
