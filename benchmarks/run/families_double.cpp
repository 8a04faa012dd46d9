// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_double() {
  auto list = all_forces<Vec3d, Rigid3d, Vec1d>();
  for (auto const& more : {rarer_mappings<Vec3d>(), points<Vec3d>()})
    list.insert(list.end(), more.begin(), more.end());
  return list;
}
