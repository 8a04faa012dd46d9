// SPDX-License-Identifier: BSL-1.0
// A grid of 10 x 6 x 8 points and springs, and the string that carries a rigid body.
#include <sinew/topology/regular_grid_topology.hpp>

#include "scenes.hpp"
#include "string_on_rigid/scene.hpp"

namespace guard {

using namespace sinew;

void spring_grid(int steps) {
  std::vector<Index> held;
  for (Index i = 0; i < 10 * 6 * 8; i += 10) held.push_back(i);
  run(Simulation{node<"root">(
          Gravity{{0, -9.81, 0}},
          EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
          CGLinearSolver<>{.iterations = 25, .tolerance = 0},
          node<"grid">(
              RegularGridTopology{.n = {10, 6, 8}, .min = {0, 0, 0}, .max = {0.9, 0.5, 0.7}},
              MechanicalObject<Vec3d>{},
              UniformMass<Vec3d>{.totalMass = 1},
              RegularGridSpringForceField<Vec3d>{
                  .linesStiffness = 300, .linesDamping = 0.1, .cubesStiffness = 300, .cubesDamping = 0.1},
              FixedConstraint<Vec3d>{.indices = held}))},
      steps,
      0.01);
}

void string(int steps) {
  run(examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<>{.iterations = 25, .tolerance = 0}),
      steps,
      0.01);
}

}  // namespace guard
