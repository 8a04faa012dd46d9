// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <sinew/io/pvd_series.hpp>

#include <cstdio>

int main() try {
  auto sim = examples::one_tetrahedron();
  sim.init();
  sinew::io::PvdSeries series("out/one_tetrahedron");
  for (int i = 0; i <= 200; ++i) {
    if (i % 4 == 0) series.add(sim.time(), sim.at<"tetrahedron/skin">().visual().current());
    sim.animate(0.01);
  }
  std::printf(
      "one tetrahedron: %zu skin vertices followed 4 points for %.2f s; open out/one_tetrahedron.pvd\n",
      sim.at<"tetrahedron/skin">().visual().size(),
      sim.time());
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "one_tetrahedron: %s\n", error.what());
  return 1;
}
