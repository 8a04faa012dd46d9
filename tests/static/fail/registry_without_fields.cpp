// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a class of a registry has no fields()
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/node.hpp>

using namespace sinew;

struct Pull {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Pull";
  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, V&, X const&, V const&) {}
  void addDForce(MechanicalParams const&, V&, V const&) const {}
  double potentialEnergy(X const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
};
struct Mine : Registry<UniformMass<Vec3d>, Pull> {};

int main() {
  RuntimeNode<Mine> root;
  root.name = "scene";
}
