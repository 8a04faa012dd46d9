// SPDX-License-Identifier: BSL-1.0
// Steps a second of a grid of springs: grid NX NY NZ STEPS. Prints lines as fem does.
#include "bodies.hpp"

using namespace bench;

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::fprintf(stderr, "usage: grid NX NY NZ STEPS\n");
    return 2;
  }
  const std::array<int, 3> n{whole_number(argv[1]), whole_number(argv[2]), whole_number(argv[3])};
  const int steps = whole_number(argv[4]);
  report("double", spring_grid<Vec3d>(n, all_iterations<CompressedRowSparseMatrixMat3x3d>()), steps);
  report("float", spring_grid<Vec3f>(n, all_iterations<CompressedRowSparseMatrixMat3x3f>()), steps);
  report("double-matrix-free", spring_grid<Vec3d>(n, all_iterations<GraphScattered>()), steps);
  report("float-matrix-free", spring_grid<Vec3f>(n, all_iterations<GraphScattered>()), steps);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "grid: %s\n", error.what());
  return 1;
}
