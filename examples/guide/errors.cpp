// SPDX-License-Identifier: BSL-1.0
// The messages of settings, files and steps that are wrong, and how a program goes on after them.
#include <sinew/io/read_gmsh.hpp>
#include <sinew/mechanics.hpp>

#include <cstdio>

using namespace sinew;

template <class F>
void try_to(F&& f) {
  try {
    f();
  } catch (Error const& error) {
    std::printf("%s\n\n", error.what());
  }
}

int main() {
  // a setting out of its range, found by init()
  try_to([] {
    Simulation sim{node<"root">(EulerExplicitSolver{},
                                node<"ball">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                             UniformMass<Vec3d>{.vertexMass = -1}))};
    sim.init();
  });
  // a file that is not there
  try_to([] { io::read_gmsh("no_such_liver.msh"); });
  // steps that are too long for their solver
  try_to([] {
    Simulation sim{
        node<"root">(EulerExplicitSolver{},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                     UniformMass<Vec3d>{.vertexMass = 1},
                     StiffSpringForceField<Vec3d>{
                         .springs = {{.first = 0, .second = 1, .stiffness = 1e6, .length = 0.5}}})};
    sim.init();
    while (sim.time() < 100) sim.animate(0.1);
  });
}
