// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component with role::Carving has no 'std::string toolModel{}, surfaceModelPath{}'
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Drill {
  using Role = role::Carving;
  static constexpr std::string_view className = "Drill";
  static constexpr auto fields() { return field_list(); }
  bool active = true;
  std::optional<double> carvingDistance{};
  long removed = 0;
  std::string message{};
};

int main() {
  Simulation sim{node<"root">(DefaultPipeline{},
                              BruteForceBroadPhase{},
                              BVHNarrowPhase{},
                              MinProximityIntersection{},
                              DefaultContactManager{},
                              Drill{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
