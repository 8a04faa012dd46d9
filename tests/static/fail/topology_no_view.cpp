// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a topology has no 'TopologyView view() const'
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Chain {
  using Role = role::Topology;
  static constexpr std::string_view className = "Chain";
  static constexpr auto fields() { return field_list(); }
  template <class D>
  void init(InitContext<D> const&) {}
};

int main() {
  Simulation sim{
      node<"root">(Chain{}, EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
