// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The points on the border of a surface: those of the edges that one triangle or quad only has.
struct MeshBoundaryROI {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshBoundaryROI";

  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<int> inputROI{};

  static constexpr auto fields() {
    using R = MeshBoundaryROI;
    return field_list(field("triangles", &R::triangles, "", "of the surface", range::nonNegative),
                      field("quads", &R::quads, "", "of the surface", range::nonNegative),
                      field("inputROI",
                            &R::inputROI,
                            "",
                            "points of the part of the surface whose border it is; none for all",
                            range::nonNegative));
  }

  std::vector<int> indices{};  // after update

  static constexpr auto outputs() {
    return field_list(field("indices", &MeshBoundaryROI::indices, "", "the points, in rising order"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <map>
#include <set>

namespace sinew {

SINEW_ONCE void MeshBoundaryROI::update(std::string_view where) {
  check_fields(*this, where);
  const std::set<int> part(inputROI.begin(), inputROI.end());
  std::map<Edge, int> uses;
  auto add = [&](auto const& face) {
    if (!part.empty() && !std::all_of(face.begin(), face.end(), [&](Index i) { return part.count(i) > 0; }))
      return;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
      ++uses[{low, high}];
    }
  };
  for (auto const& t : triangles) add(t);
  for (auto const& q : quads) add(q);
  std::set<int> onBorder;
  for (auto const& [edge, count] : uses)
    if (count == 1) onBorder.insert(edge.begin(), edge.end());
  indices.assign(onBorder.begin(), onBorder.end());
}

}  // namespace sinew
#endif
