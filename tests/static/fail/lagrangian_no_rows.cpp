// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a Lagrangian constraint has no 'void addRows(
#include <sinew/lagrangian.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Peg {
  using Role = role::LagrangianConstraint;
  using DataTypes = Vec3d;
  static constexpr std::string_view className = "Peg";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void addRows(ConstraintRows&) const {}
};

int main() {
  Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                              BlockGaussSeidelConstraintSolver{},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              Peg{})};
  sim.init();
  sim.animate(0.1);
}
