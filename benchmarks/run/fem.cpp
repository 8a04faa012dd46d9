// SPDX-License-Identifier: BSL-1.0
// Steps a second of one corotational body: fem MESH STEPS. dt 0.02, E 3000, 25 conjugate-gradient iterations
// a step with no early exit. Prints one line a kind: kind, steps a second, and the position of point 100 at
// the end.
#include "bodies.hpp"

#include <sinew/io/mesh_file.hpp>

using namespace bench;

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: fem MESH STEPS\n");
    return 2;
  }
  const Mesh mesh = io::read_mesh(argv[1]);
  const int steps = whole_number(argv[2]);
  using Blocks = CompressedRowSparseMatrixMat3x3d;
  using Floats = CompressedRowSparseMatrixMat3x3f;
  report("double", body<Vec3d>(mesh, all_iterations<Blocks>()), steps);
  report("double-float-matrix", body<Vec3d>(mesh, all_iterations<Floats>()), steps);
  report("float", body<Vec3f>(mesh, all_iterations<Floats>()), steps);
  report("double-matrix-free", body<Vec3d>(mesh, all_iterations<GraphScattered>()), steps);
  report("float-matrix-free", body<Vec3f>(mesh, all_iterations<GraphScattered>()), steps);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "fem: %s\n", error.what());
  return 1;
}
