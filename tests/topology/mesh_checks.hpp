// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "error_of.hpp"

#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// Whether each face belongs to one tetrahedron, or to two that see it from different sides, and each point
/// is used. Written without the library's own face code.
inline bool is_conforming(sinew::Mesh const& mesh) {
  std::map<sinew::Triangle, std::pair<int, int>> faces;  // sorted points: tetrahedra on either side
  std::vector<bool> used(mesh.positions.size(), false);
  for (auto const& t : mesh.tetrahedra) {
    for (const int i : t) used.at(std::size_t(i)) = true;
    for (std::size_t skip = 0; skip < 4; ++skip) {
      sinew::Triangle f{};
      for (std::size_t i = 0, n = 0; i < 4; ++i)
        if (i != skip) f[n++] = t[i];
      int inversions = int(skip);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 3; ++j)
          if (f[i] > f[j]) std::swap(f[i], f[j]), ++inversions;
      ++(inversions % 2 == 0 ? faces[f].first : faces[f].second);
    }
  }
  for (auto const& [face, sides] : faces)
    if (sides.first > 1 || sides.second > 1) return false;
  for (const bool u : used)
    if (!u) return false;
  return true;
}
