// SPDX-License-Identifier: BSL-1.0
#include "laparoscopy.hpp"

bench::Laparoscopy bench::time_fem(examples::LaparoscopyBodies const& bodies, long steps) {
  return time_laparoscopy<examples::FemOrgans>(bodies, steps);
}
