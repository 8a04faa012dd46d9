// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a force field has no 'void addForce(
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

using namespace sinew;

struct Pull {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Pull";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void addDForce(MechanicalParams const&, V&, V const&) const {}
  double potentialEnergy(X const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
};
struct Mine : Registry<Standard, Pull> {};

int main() {
  auto scene = read_scene<Mine>("scene.scn");
  Simulation sim = start(std::move(scene));
  sim.animate(scene.dt);
}
