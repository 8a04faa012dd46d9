// SPDX-License-Identifier: BSL-1.0
#include <sinew/gpu/fused/simulation.hpp>  // before the components

#include <sinew/sinew.hpp>

#include <cstdio>

// A sweep over a parameter: bars of eight stiffnesses bend under their weight at the same time, each step of
// all of them one kernel. Prints how far the end of each has sunk after a second.
int main() try {
  using namespace sinew;
  constexpr int copies = 8;
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  std::vector<int> held;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].x() < 0.01) held.push_back(int(i));
  auto bar = [&](double youngModulus) {
    Simulation sim{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-6},
        node<"bar">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                    MechanicalObject<CudaVec3d>{},
                    DiagonalMass<CudaVec3d>{.massDensity = 1000},
                    TetrahedronFEMForceField<CudaVec3d>{.youngModulus = {youngModulus}, .poissonRatio = 0.4},
                    FixedConstraint<CudaVec3d>{.indices = held}))};
    sim.init();
    return sim;
  };
  auto stiffness = [](int copy) { return 4e5 * (copy + 1); };

  // all copies have the elements of the first scene; each is given the materials of its own
  auto sim = bar(stiffness(0));
  gpu::FusedSimulation sweep(sim, copies);
  for (int copy = 0; copy < copies; ++copy) {
    auto one = bar(stiffness(copy));
    sweep.load(copy, one);
  }
  sweep.animate(0.02, 50);
  for (int copy = 0; copy < copies; ++copy) {
    sweep.store(copy, sim);
    std::printf("Young's modulus %.1f MPa: the end sinks by %.4f m\n",
                stiffness(copy) / 1e6,
                mesh.positions.back().y() - double(sim.at<"bar">().state().position.back().y()));
  }
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "gpu_sweep: %s\n", error.what());
  return 1;
}
