// SPDX-License-Identifier: BSL-1.0
#include "laparoscopy.hpp"

bench::Laparoscopy bench::time_grid(examples::LaparoscopyBodies const& bodies, long steps) {
  return time_laparoscopy<examples::GridOrgans>(bodies, steps);
}
