// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/gpu.hpp>  // before the components

#include <sinew/sinew.hpp>

#include <cstdio>

// A soft bar, 3 m long, is held at one end and bends under its weight for two seconds.
int main() try {
  using namespace sinew;
  const Mesh mesh = regular_grid_tetrahedra(13, 5, 5, {0, 0, 0}, {3, 1, 1});
  std::vector<int> held;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].x() < 0.01) held.push_back(int(i));
  Simulation sim{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-6},
      node<"bar">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                  MechanicalObject<CudaVec3f>{},
                  DiagonalMass<CudaVec3f>{.massDensity = 1000},
                  TetrahedronFEMForceField<CudaVec3f>{.youngModulus = {1e6}, .poissonRatio = 0.4},
                  FixedConstraint<CudaVec3f>{.indices = held}))};
  sim.init();
  while (sim.time() < 2) sim.animate(0.02);
  // what the host looks at is copied from the device
  auto const& end = sim.at<"bar">().state().position.back();
  std::printf(
      "after %.2f s the end of the bar is at (%.3f, %.3f, %.3f)\n", sim.time(), end[0], end[1], end[2]);
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "gpu_bar: %s\n", error.what());
  return 1;
}
