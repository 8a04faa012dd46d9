// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an interaction has no 'void addDForce(
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

template <class Between>
struct Tie {
  using Role = role::InteractionForceField;
  using DataTypes = Vec3d;
  using Ends = Between;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Tie";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&, InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, V&, V&, X const&, X const&, V const&, V const&) {}
  void addDForce(MechanicalParams const&, V&, V const&) const {}
  double potentialEnergy(X const&, X const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
};

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              node<"a">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                              node<"b">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                              Tie<Between<"a", "b">>{})};
  sim.init();
  sim.animate(0.1);
}
