// SPDX-License-Identifier: BSL-1.0
#include "families_rarer.hpp"

std::vector<bench::Work> bench::in_float() {
  auto list = all_forces<Vec3f, Rigid3f, Vec1f>();
  for (auto& work : points<Vec3f>()) list.push_back(std::move(work));
  return list;
}
