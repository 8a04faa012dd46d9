// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a constraint solver has no 'void solve(ConstraintProblem& problem, std::string_view where)'
#include <sinew/lagrangian.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Guess {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "Guess";
  static constexpr auto fields() { return field_list(); }
  void solve(ConstraintProblem&) const {}
};

int main() {
  Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                              Guess{},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
