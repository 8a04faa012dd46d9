// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <cstdio>

namespace cli {

int check(CheckOptions const& options) {
  // what is wrong with the file is said all at once, then what is wrong with the scene that it makes
  Scene ready = start(read(options.scene), options.scene);
  if (options.quiet) return ok;
  print_notes(ready.ignored, ready.warnings);
  std::printf("%s: ok: %s\n", options.scene.path.c_str(), count(ready.simulation.root()).words().c_str());
  return ok;
}

}  // namespace cli
