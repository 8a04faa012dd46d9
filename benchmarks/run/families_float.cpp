// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_float() {
  auto list = all_forces<Vec3f, Rigid3f, Vec1f>();
  for (auto const& more : {rarer_mappings<Vec3f>(), points<Vec3f>()})
    list.insert(list.end(), more.begin(), more.end());
  return list;
}
