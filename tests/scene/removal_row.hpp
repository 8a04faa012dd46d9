// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>

#include "catch.hpp"

namespace removal {

using namespace sinew;

/// Three tetrahedra in a row: point i and i + 1, i + 2, i + 3.
inline std::vector<Eigen::Vector3d> row() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 6; ++i) points.push_back({double(i), i % 2 ? 1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0});
  return points;
}
inline std::vector<Tetrahedron> tetrahedra() {
  std::vector<Tetrahedron> all{{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}};
  const auto x = row();
  auto at = [&](Index i) { return x[std::size_t(i)]; };
  for (auto& t : all)
    if ((at(t[1]) - at(t[0])).dot((at(t[2]) - at(t[0])).cross(at(t[3]) - at(t[0]))) < 0)
      std::swap(t[2], t[3]);
  return all;
}

}  // namespace removal
