// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a step callback has no 'void call(StepInfo const& step)'
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Watch {
  using Role = role::StepCallback;
  static constexpr std::string_view className = "Watch";
  static constexpr auto fields() { return field_list(); }
};

int main() {
  Simulation sim{
      node<"root">(EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, Watch{})};
  sim.init();
  sim.animate(0.1);
}
