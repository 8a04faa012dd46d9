// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a force field, mass, constraint or collision model has no state to act on
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>

using namespace sinew;

int main() {
  Simulation sim{node<"root">(EulerExplicitSolver{}, FixedConstraint<Vec3d>{})};
  sim.init();
  sim.animate(0.1);
}
