// SPDX-License-Identifier: BSL-1.0
// Runs vitrectomy.scn: a program for scene files with components of its own.
#include "registry.hpp"

#include "support/progress.hpp"

#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/save_scene.hpp>

#include <cmath>

int main(int argc, char** argv) try {
  using namespace sinew;
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: vitrectomy_scene SCENE DATA-FOLDER [SECONDS]\n");
    return 2;
  }
  auto scene = read_scene<examples::VitrectomyComponents>(argv[1], {.dataPaths = {argv[2]}});
  for (auto const& warning : scene.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  const double dt = scene.dt;
  const long steps = std::lround((argc == 4 ? std::atof(argv[3]) : 7) / dt);
  auto sim = start(std::move(scene));
  auto* springs = sim.root().find_node("eye")->get<examples::CuttableSpringForceField<Vec3d>>();
  std::printf("%zu springs to cut, %.2f nJ in all\n", springs->springs.size(), 1e9 * sim.potentialEnergy());
  examples::Progress progress(steps);
  for (long i = 1; i <= steps; ++i) {
    sim.animate(dt);
    progress.at(i);
    if (i % std::lround(1 / dt) == 0 || i == steps)
      std::printf("%5.2f s: %4zu springs to cut, %10.3f nJ in all\n",
                  sim.time(),
                  springs->springs.size(),
                  1e9 * sim.potentialEnergy());
  }
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "vitrectomy_scene: %s\n", error.what());
  return 1;
}
