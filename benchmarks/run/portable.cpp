// SPDX-License-Identifier: BSL-1.0
// Steps a second of a body and of a grid of springs, built for one kind of processor: portable CELLS STEPS.
// Prints first how many bytes a vector register has, then one line a scene: name, steps a second; and a line
// `at NAME` with all coordinates after 20 steps, for comparison with the builds for other processors.
#include "bodies.hpp"

using namespace bench;

namespace {

template <class Scene>
void measure(char const* name, Scene scene, int steps) {
  scene.init();
  for (int i = 0; i < 20; ++i) scene.animate(0.02);
  std::printf("at %s", name);
  for (auto const& x : scene.root().state().position)
    for (int c = 0; c < 3; ++c) std::printf(" %.17g", double(x[c]));
  std::printf("\n");
  std::printf("%s %.3f\n", name, 1 / seconds_a_step(scene, steps));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: portable CELLS STEPS\n");
    return 2;
  }
  const int cells = whole_number(argv[1]), steps = whole_number(argv[2]);
  if (cells < 4 || cells > 100) throw Error("arguments", "CELLS is 4 to 100");
  const Mesh mesh = block(cells);
  using Blocks = CompressedRowSparseMatrixMat3x3d;
  std::printf("bytes %d\n", vector_bytes);
  measure("fem-double", body<Vec3d>(mesh, all_iterations<Blocks>()), steps);
  measure("fem-float", body<Vec3f>(mesh, all_iterations<CompressedRowSparseMatrixMat3x3f>()), steps);
  measure("fem-double-matrix-free", body<Vec3d>(mesh, all_iterations<GraphScattered>()), steps);
  measure("grid-double", spring_grid<Vec3d>({17, 8, 10}, all_iterations<Blocks>()), steps);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "portable: %s\n", error.what());
  return 1;
}
