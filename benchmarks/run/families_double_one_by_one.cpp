// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_double_one_by_one() {
  return all_forces<WithLanes<Vec3d, 1>, Rigid3d, WithLanes<Vec1d, 1>>();
}
