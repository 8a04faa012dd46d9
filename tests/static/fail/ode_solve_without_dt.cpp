// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: an ODE solver has no 'template <class Operations> void solve(
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Stepper {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "Stepper";
  static constexpr bool implicit = false;
  static constexpr Auxiliary auxiliary{};
  static constexpr auto fields() { return field_list(); }
  template <class Operations>
  void solve(Operations&) const {}
};

int main() {
  Simulation sim{node<"root">(Stepper{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
