// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component has 'projectvelocity', which nothing looks for
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Hold {
  using Role = role::ProjectiveConstraint;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  static constexpr std::string_view className = "Hold";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void projectResponse(V&) const {}
  void projectvelocity(double, V&) const {}
  template <class Sink>
  void projectMatrix(Sink const&) const {}
};

int main() {
  Simulation sim{
      node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, Hold{})};
  sim.init();
  sim.animate(0.1);
}
