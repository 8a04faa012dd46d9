// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a linear solver has no 'template <class Operations> void init(
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Inverse {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "Inverse";
  static constexpr Auxiliary auxiliary{};
  static constexpr bool needsPattern = false;
  static constexpr auto fields() { return field_list(); }
  template <class Operations, class Vector>
  void solve(Operations&, MatrixFactors, Vector&, Vector&) const {}
};

int main() {
  Simulation sim{
      node<"root">(EulerImplicitSolver{}, Inverse{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
