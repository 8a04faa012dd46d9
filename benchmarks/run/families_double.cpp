// SPDX-License-Identifier: BSL-1.0
#include "families_of.hpp"

std::vector<bench::Work> bench::in_double() {
  auto list = forces<Vec3d>();
  for (auto& work : points<Vec3d>()) list.push_back(std::move(work));
  return list;
}
