// SPDX-License-Identifier: BSL-1.0
// One scene for several numbers and matrices: how fast each is, and how far apart the results are.
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <chrono>
#include <cstdio>

using namespace sinew;

/// Shakes a block over the DataTypes D for a second, and gives back where its last point is.
template <class D, class LinearSolver>
Eigen::Vector3d shake(char const* name, Mesh const& block, LinearSolver linearSolver) {
  MechanicalObject<D> state;
  for (auto const& p : block.positions) state.position.push_back(p.template cast<typename D::Real>());
  std::vector<int> held;
  for (std::size_t i = 0; i < block.positions.size(); ++i)
    if (block.positions[i].x() == 0) held.push_back(int(i));
  Simulation sim{node<"block">(Gravity{{0, -9.81, 0}},
                               EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                               linearSolver,
                               TetrahedronTopology{block.tetrahedra},
                               state,
                               UniformMass<D>{.totalMass = 10},
                               TetrahedronFEMForceField<D>{.youngModulus = {20000}, .poissonRatio = 0.3},
                               FixedConstraint<D>{.indices = held})};
  sim.init();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 50; ++i) sim.animate(0.02);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  const Eigen::Vector3d end = sim.root().state().position.back().template cast<double>();
  std::printf("%-28s %6.0f steps/s, the end at y = %.6f m\n", name, 50 / taken.count(), end.y());
  return end;
}

int main() {
  const Mesh block = regular_grid_tetrahedra(11, 4, 4, {0, 0, 0}, {0.4, 0.1, 0.1});
  const CGLinearSolver<> matrixFree{.iterations = 200, .tolerance = 1e-10};
  const CGLinearSolver<CompressedRowSparseMatrixMat3x3d> assembled{.iterations = 200, .tolerance = 1e-10};
  const CGLinearSolver<CompressedRowSparseMatrixMat3x3f> single{.iterations = 200, .tolerance = 1e-10};
  shake<Vec3d>("double, no matrix", block, matrixFree);
  shake<WithLanes<Vec3d, 1>>("the same, element by element", block, matrixFree);
  shake<Vec3d>("double, a matrix", block, assembled);
  shake<Vec3d>("double, factors of it", block, SparseLDLSolver<>{});
  shake<Vec3f>("float, a matrix", block, single);
}
