// SPDX-License-Identifier: BSL-1.0
#include "families_of.hpp"

std::vector<bench::Work> bench::in_float() {
  auto list = forces<Vec3f>();
  for (auto& work : points<Vec3f>()) list.push_back(std::move(work));
  return list;
}
