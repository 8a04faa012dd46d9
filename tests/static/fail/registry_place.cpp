// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component has 'addforce', which nothing looks for
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Pull {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Pull";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void addforce(MechanicalParams const&, V&, X const&, V const&) {}
  void addDForce(MechanicalParams const&, V&, V const&) const {}
  double potentialEnergy(X const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
};
struct Mine : Registry<EulerExplicitSolver, MechanicalObject<Vec3d>, UniformMass<Vec3d>, Pull> {};

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, RuntimePlace<"guest", Mine>{})};
  sim.init();
  sim.animate(0.1);
}
