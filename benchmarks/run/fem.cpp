// SPDX-License-Identifier: BSL-1.0
// Steps a second of one corotational body: fem MESH STEPS. Implicit Euler with Rayleigh damping 0.1/0.1, dt 0.02, E 3000,
// nu 0.3, density 1, points 3, 39, 64 fixed, 25 conjugate-gradient iterations a step with no early exit. Prints one line a
// kind: kind, steps a second, and the position of point 100 at the end.
#include <sinew/io/mesh_file.hpp>
#include <sinew/sinew.hpp>

#include "paired.hpp"

#include <cstdlib>

using namespace sinew;

namespace {

template <class D, class Matrix>
void run(char const* kind, Mesh const& mesh, int steps) {
  typename D::VecCoord points;
  for (auto const& p : mesh.positions) points.push_back(p.template cast<typename D::Real>());
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                              CGLinearSolver<Matrix>{.iterations = 25, .tolerance = 0},
                              TetrahedronTopology{mesh.tetrahedra},
                              MechanicalObject<D>{points},
                              DiagonalMass<D>{.massDensity = 1},
                              TetrahedronFEMForceField<D>{.youngModulus = {3000},
                                                          .poissonRatio = 0.3,
                                                          .method = RotationMethod::gradient},
                              FixedConstraint<D>{.indices = {3, 39, 64}})};
  sim.init();
  const double time = bench::seconds([&] {
    for (int i = 0; i < steps; ++i) sim.animate(0.02);
  });
  auto const& x = sim.root().state().position;
  auto const& probe = x[std::min<std::size_t>(100, x.size() - 1)];
  std::printf("%s %.2f %.6f %.6f %.6f\n", kind, steps / time, double(probe[0]), double(probe[1]), double(probe[2]));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 || std::atoi(argv[2]) < 1) {
    std::fprintf(stderr, "usage: fem MESH STEPS\n");
    return 2;
  }
  const Mesh mesh = io::read_mesh(argv[1]);
  const int steps = std::atoi(argv[2]);
  run<Vec3d, CompressedRowSparseMatrixMat3x3d>("double", mesh, steps);
  run<Vec3d, CompressedRowSparseMatrixMat3x3f>("double-float-matrix", mesh, steps);
  run<Vec3f, CompressedRowSparseMatrixMat3x3f>("float", mesh, steps);
  run<Vec3d, GraphScattered>("double-matrix-free", mesh, steps);
  run<Vec3f, GraphScattered>("float-matrix-free", mesh, steps);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "fem: %s\n", error.what());
  return 1;
}
