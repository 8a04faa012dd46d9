// SPDX-License-Identifier: BSL-1.0
#include <sinew/sinew.hpp>

#include <cmath>

using namespace sinew;

// A ball falls for a second: symplectic Euler gives -g h^2 n (n + 1) / 2.
int main() {
  Simulation sim{node<"root">(Gravity{{0, -10, 0}},
                              EulerExplicitSolver{},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                              UniformMass<Vec3d>{})};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.1);
  return std::abs(sim.root().state().position[0].y() + 5.5) < 1e-12 ? 0 : 1;
}
