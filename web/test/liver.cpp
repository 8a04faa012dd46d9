// SPDX-License-Identifier: BSL-1.0
// The scene that the page runs as WebAssembly, run here: prints the positions of its skin after some steps,
// which web/test/page.mjs compares.
#include "../engine/liver.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
  auto sim = page::liver();
  sim.init();
  for (int i = argc > 1 ? std::atoi(argv[1]) : 0; i > 0; --i) sim.animate(page::dt);
  sim.updateVisual();
  for (auto const& p : sim.at<"liver/skin">().visual().current().positions)
    std::printf("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
} catch (std::exception const& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
