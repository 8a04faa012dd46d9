// SPDX-License-Identifier: BSL-1.0
#include "bodies.hpp"
#include "options.hpp"

#include <sinew/core/error.hpp>

#include <cstdio>

namespace examples {

void run_fem(LaparoscopyBodies const& bodies, LaparoscopyOptions const& options);
void run_grid(LaparoscopyBodies const& bodies, LaparoscopyOptions const& options);

}  // namespace examples

int main(int argc, char** argv) try {
  using namespace examples;
  LaparoscopyOptions options;
  int status = 0;
  if (!read_options(argc, argv, options, status)) return status;
  if (options.grid[0] > 0)
    run_grid(make_bodies(options.grid), options);
  else
    run_fem(make_bodies(options.tetrahedra), options);
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "laparoscopy: %s\n", error.what());
  return 1;
}
