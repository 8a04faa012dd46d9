// SPDX-License-Identifier: BSL-1.0
// A runtime tree of the standard registry against the typed tree of the same scene: time a step of both, and
// the ratio, as medians of 11 rounds in turn. Small scenes show the cost of finding components at run time;
// from some hundred points on it is lost in the mechanics.
#include "paired.hpp"

#include "one_tetrahedron/scene.hpp"
#include "string_on_rigid/scene.hpp"

#include <sinew/runtime/from_typed.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cmath>

using namespace sinew;

namespace {

/// Kinetic and potential energy: where they agree bit by bit, the states do.
template <class Sim>
void compare(char const* name, Sim typed, double dt) {
  StandardSimulation runtime(to_runtime<Standard>(typed.root()));
  typed.init();
  runtime.init();
  std::size_t points = 0;
  const RuntimeScope<Standard> scope(runtime.root());
  MechanicalOperations<RuntimeScope<Standard>> operations(scope);
  operations.forEachState([&](auto& s) { points += s.size(); });
  const int steps =
      std::max(1, int(0.03 / bench::processor_seconds([&] { typed.animate(dt), runtime.animate(dt); })));
  const auto pair = bench::paired(
      11,
      [&] {
        for (int i = 0; i < steps; ++i) runtime.animate(dt);
      },
      [&] {
        for (int i = 0; i < steps; ++i) typed.animate(dt);
      });
  const bool same = typed.kineticEnergy() == runtime.kineticEnergy() &&
                    typed.potentialEnergy() == runtime.potentialEnergy();
  std::printf("%-34s %6zu points  runtime %10.3f us/step  typed %10.3f us/step  ratio %.3f  %s\n",
              name,
              points,
              1e6 * pair.first / steps,
              1e6 * pair.second / steps,
              pair.ratio,
              same ? "same bits" : "other bits");
  std::fflush(stdout);
}

template <class Linear>
auto block(int n, Linear linear) {
  const Mesh mesh = regular_grid_tetrahedra(n, n, n, {0, 0, 0}, {1, 1, 1});
  std::vector<int> fixed;
  for (int i = 0; i < n * n; ++i) fixed.push_back(i);
  return Simulation{node<"root">(
      Gravity{},
      EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
      linear,
      node<"body">(TetrahedronTopology{mesh.tetrahedra},
                   MechanicalObject<Vec3d>{mesh.positions},
                   DiagonalMass<Vec3d>{.massDensity = 1000},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {100000}, .poissonRatio = 0.3},
                   FixedConstraint<Vec3d>{.indices = fixed}))};
}

}  // namespace

int main() {
  compare("string on rigid, explicit", examples::string_on_rigid(EulerExplicitSolver{}), 0.0005);
  compare("string on rigid, matrix-free",
          examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<>{}),
          0.005);
  compare("one tetrahedron, matrix-free", examples::one_tetrahedron(), 0.01);
  for (const int n : {4, 6, 8, 10, 18}) {
    char name[64];
    std::snprintf(name, sizeof name, "FEM block %d^3, matrix-free", n);
    compare(name, block(n, CGLinearSolver<>{.iterations = 25, .tolerance = 0}), 0.02);
    std::snprintf(name, sizeof name, "FEM block %d^3, assembled", n);
    compare(name,
            block(n, CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 25, .tolerance = 0}),
            0.02);
  }
}
