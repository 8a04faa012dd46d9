// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a broad phase has no 'template <class F> void pairs(
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Sweep {
  using Role = role::BroadPhase;
  static constexpr std::string_view className = "Sweep";
  static constexpr auto fields() { return field_list(); }
  template <class F>
  void pairs(std::vector<CollisionSurface>&, F&&) {}
};

int main() {
  Simulation sim{node<"root">(DefaultPipeline{},
                              Sweep{},
                              BVHNarrowPhase{},
                              MinProximityIntersection{},
                              DefaultContactManager{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
