// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an intersection method has no 'double reach() const'
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Never {
  using Role = role::Intersection;
  static constexpr std::string_view className = "Never";
  static constexpr auto fields() { return field_list(); }
  static constexpr bool continuous = false;
  double reach() { return 0.1; }
  template <Shape A, Shape B>
  std::optional<Contact> intersect(PrimitivePair<A, B> const&) const {
    return std::nullopt;
  }
};

int main() {
  Simulation sim{node<"root">(DefaultPipeline{},
                              BruteForceBroadPhase{},
                              BVHNarrowPhase{},
                              Never{},
                              DefaultContactManager{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
