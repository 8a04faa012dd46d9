// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a collision pipeline has no 'std::vector<CollisionSurface*> surfaces{}'
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Detection {
  using Role = role::CollisionPipeline;
  static constexpr std::string_view className = "Detection";
  static constexpr auto fields() { return field_list(); }
  std::vector<std::pair<int, int>> near{};
  template <class Broad>
  void findNear(Broad&) {}
  template <Shape... Known, class Narrow, class Method, class Manager>
  void findContacts(ShapeList<Known...>, Narrow&, Method const&, Manager&, double) {}
};

int main() {
  Simulation sim{node<"root">(Detection{},
                              BruteForceBroadPhase{},
                              BVHNarrowPhase{},
                              MinProximityIntersection{},
                              DefaultContactManager{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
