// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mass has an exactInverse that nothing calls
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Heavy {
  using Role = role::Mass;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Heavy";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, V&, X const&, V const&) const {}
  void addMDx(V&, X const&, V const&, double) const {}
  void accFromF(V&, X const&, V const&) const {}
  bool exactInverse(double) const { return true; }
  double kineticEnergy(X const&, V const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, X const&, Sink const&) const {}
};

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, Heavy{})};
  sim.init();
  sim.animate(0.1);
}
