// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a contact manager has no 'void takeModels(std::vector<CollisionSurface*> const& models)', 'void settle()'
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Counting {
  using Role = role::ContactManager;
  static constexpr std::string_view className = "Counting";
  static constexpr auto fields() { return field_list(); }
  std::vector<Contact> contacts{}, attachments{};
  bool couplingChanged = false;
  bool acts() const { return !contacts.empty(); }
  void init(std::string const&, std::vector<CollisionSurface*> const&, bool) {}
  void takeModels(std::vector<CollisionSurface*> const&) {}
  void settle() {}
  void add(Contact const& c) { contacts.push_back(c); }
};

int main() {
  Simulation sim{node<"root">(DefaultPipeline{},
                              BruteForceBroadPhase{},
                              BVHNarrowPhase{},
                              MinProximityIntersection{},
                              Counting{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              SphereCollisionModel<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
