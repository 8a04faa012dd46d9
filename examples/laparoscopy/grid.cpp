// SPDX-License-Identifier: BSL-1.0
#include "run.hpp"

namespace examples {

void run_grid(LaparoscopyBodies const& bodies, LaparoscopyOptions const& options) {
  run<GridOrgans>(bodies, options);
}

}  // namespace examples
