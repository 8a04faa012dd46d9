// SPDX-License-Identifier: BSL-1.0
#include "run.hpp"

namespace examples {

void run_fem(LaparoscopyBodies const& bodies, LaparoscopyOptions const& options) {
  run<FemOrgans>(bodies, options);
}

}  // namespace examples
