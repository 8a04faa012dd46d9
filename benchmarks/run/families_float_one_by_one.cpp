// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_float_one_by_one() {
  return all_forces<WithLanes<Vec3f, 1>, Rigid3f, WithLanes<Vec1f, 1>>();
}
