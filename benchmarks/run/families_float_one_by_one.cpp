// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_float_one_by_one() {
  return all_forces<WithLanes<Vec3f, 1>, WithLanes<Rigid3f, 1>, WithLanes<Vec1f, 1>>();
}
