// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Some triangles of a surface, thickened along the unit normals of their points into a closed surface: the
/// triangles with their orientation reversed, those at the height, and the sides along their border, which
/// all look outwards (in SOFA some of the sides look inwards).
struct ExtrudeSurface {
  using Role = role::Engine;
  static constexpr std::string_view className = "ExtrudeSurface";

  std::vector<Eigen::Vector3d> surfaceVertices{};
  std::vector<Triangle> triangles{};
  std::vector<int> surfaceTriangles{};
  double heightFactor = 1;

  static constexpr auto fields() {
    using E = ExtrudeSurface;
    return field_list(
        field("surfaceVertices", &E::surfaceVertices, "m", "points of the surface"),
        field("triangles", &E::triangles, "", "of the surface", range::nonNegative),
        field("surfaceTriangles", &E::surfaceTriangles, "", "those that are thickened", range::nonNegative),
        field("heightFactor", &E::heightFactor, "m", "height, along the normals"));
  }

  // after update
  std::vector<Eigen::Vector3d> extrusionVertices{};
  std::vector<Triangle> extrusionTriangles{};

  static constexpr auto outputs() {
    using E = ExtrudeSurface;
    return field_list(
        field("extrusionVertices", &E::extrusionVertices, "m", "each point, then where it is at the height"),
        field("extrusionTriangles",
              &E::extrusionTriangles,
              "",
              "each triangle below and above, in turn; then two for each edge of the border"));
  }

  /// Throws Error where there is no triangle, or an index is out of range; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

#include <array>
#include <map>

namespace sinew {

SINEW_ONCE void ExtrudeSurface::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (surfaceTriangles.empty())
    throw Error(at, "surfaceTriangles is empty; name triangles, such as those of a region of interest");
  detail::check_indices(at, "triangle", triangles, surfaceVertices.size());
  check_numbers(at, "surfaceTriangles", surfaceTriangles, triangles.size(), "triangles", "the surface");

  auto x = [&](Index i) -> Eigen::Vector3d const& { return surfaceVertices[std::size_t(i)]; };
  std::vector<Eigen::Vector3d> normals(surfaceVertices.size(), Eigen::Vector3d::Zero());
  for (const int t : surfaceTriangles) {
    auto const& [a, b, c] = triangles[std::size_t(t)];
    const Eigen::Vector3d n = (x(b) - x(a)).cross(x(c) - x(a)).stableNormalized();
    for (const Index i : {a, b, c}) normals[std::size_t(i)] += n;
  }

  extrusionVertices.clear(), extrusionTriangles.clear();
  std::vector<Index> number(surfaceVertices.size(), -1);
  // edges that one triangle only has, as that triangle met them first
  std::map<Edge, bool> border;
  for (const int t : surfaceTriangles) {
    Triangle low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index i = triangles[std::size_t(t)][k];
      if (number[std::size_t(i)] < 0) {
        number[std::size_t(i)] = Index(extrusionVertices.size());
        extrusionVertices.push_back(x(i));
        extrusionVertices.push_back(x(i) + heightFactor * normals[std::size_t(i)].stableNormalized());
      }
      low[k] = number[std::size_t(i)], high[k] = low[k] + 1;
    }
    for (const auto& [a, b] : {Edge{low[0], low[1]}, Edge{low[2], low[0]}, Edge{low[1], low[2]}}) {
      if (auto known = border.find({a, b}); known != border.end())
        known->second = false;
      else if (auto reversed = border.find({b, a}); reversed != border.end())
        reversed->second = false;
      else
        border[{a, b}] = true;
    }
    extrusionTriangles.push_back({low[0], low[2], low[1]});
    extrusionTriangles.push_back(high);
  }
  for (auto const& [edge, once] : border)
    if (once) {
      extrusionTriangles.push_back({edge[0], edge[1], edge[0] + 1});
      extrusionTriangles.push_back({edge[1] + 1, edge[0] + 1, edge[1]});
    }
}

}  // namespace sinew
#endif
