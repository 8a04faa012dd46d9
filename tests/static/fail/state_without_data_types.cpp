// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a MechanicalObject is over DataTypes
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  Vec3d::VecCoord points{{0, 0, 0}};
  Simulation sim{node<"root">(EulerExplicitSolver{}, MechanicalObject{points}, UniformMass<Vec3d>{})};
  sim.init();
}
