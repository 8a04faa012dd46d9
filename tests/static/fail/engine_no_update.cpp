// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an engine has no 'void update(
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Numbers {
  using Role = role::Engine;
  static constexpr std::string_view className = "Numbers";
  static constexpr auto fields() { return field_list(); }
  static constexpr auto outputs() { return field_list(); }
};

int main() {
  Simulation sim{
      node<"root">(Numbers{}, EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
