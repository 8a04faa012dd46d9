// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping has no 'void apply(
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Follow {
  using Role = role::Mapping;
  using In = Vec3d;
  using Out = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Follow";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<In> const&, InitContext<Out> const&, X&) {}
  void applyJ(V&, V const&) const {}
  void applyJT(V&, V const&) const {}
  template <class F>
  void forEachJacobianBlock(int, F&&) const {}
};

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              node<"skin">(MechanicalObject<Vec3d>{}, Follow{}))};
  sim.init();
  sim.animate(0.1);
}
