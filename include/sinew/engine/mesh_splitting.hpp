// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Divides the points of a mesh into parts, of which each has some points and those of some elements, and
/// the last what is in none; a point of several is in the first. The index pairs join the parts again in a
/// SubsetMultiMapping. In scene files indices1, tetrahedronIndices1... are of the first part, and position1,
/// position2... the points of the parts.
struct MeshSplittingEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshSplittingEngine";
  using Numbers = std::vector<std::vector<int>>;  // one list for each part

  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  int nbInputs = 0;
  Numbers indices{}, edgeIndices{}, triangleIndices{}, quadIndices{}, tetrahedronIndices{},
      hexahedronIndices{};

  static constexpr auto fields() {
    using E = MeshSplittingEngine;
    return field_list(
        field("position", &E::position, "m", "points of the mesh"),
        field("edges", &E::edges, "", "of the mesh", range::nonNegative),
        field("triangles", &E::triangles, "", "of the mesh", range::nonNegative),
        field("quads", &E::quads, "", "of the mesh", range::nonNegative),
        field("tetrahedra", &E::tetrahedra, "", "of the mesh", range::nonNegative),
        field("hexahedra", &E::hexahedra, "", "of the mesh", range::nonNegative),
        field("nbInputs", &E::nbInputs, "", "parts, beside the last", range::nonNegative),
        field("indices1", &E::indices, "", "points of the first part", range::nonNegative),
        field("edgeIndices1", &E::edgeIndices, "", "edges of the first part", range::nonNegative),
        field("triangleIndices1", &E::triangleIndices, "", "triangles of the first part", range::nonNegative),
        field("quadIndices1", &E::quadIndices, "", "quads of the first part", range::nonNegative),
        field("tetrahedronIndices1",
              &E::tetrahedronIndices,
              "",
              "tetrahedra of the first part",
              range::nonNegative),
        field("hexahedronIndices1",
              &E::hexahedronIndices,
              "",
              "hexahedra of the first part",
              range::nonNegative));
  }

  // after update
  std::vector<int> indexPairs{};
  std::vector<std::vector<Eigen::Vector3d>> positions{};

  static constexpr auto outputs() {
    using E = MeshSplittingEngine;
    return field_list(
        field("indexPairs", &E::indexPairs, "", "of each point: its part, and its number there"),
        field("position1", &E::positions, "m", "points of the first part; position2... of the others"));
  }

  /// Throws Error where there are more lists than parts, or an index is out of range; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

namespace sinew {

SINEW_ONCE void MeshSplittingEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  detail::check_elements(at, *this, position.size());
  const std::size_t n = std::size_t(nbInputs);
  std::vector<std::size_t> part(position.size(), n);
  // the first part counts
  auto put = [&](std::size_t p, Index i) { part[std::size_t(i)] = std::min(part[std::size_t(i)], p); };
  auto check = [&](std::string_view name, Numbers const& lists, std::size_t count, std::string_view things) {
    if (lists.size() > n)
      throw Error(at,
                  text("there are ",
                       lists.size(),
                       " lists ",
                       name,
                       ", but nbInputs is ",
                       n,
                       "; set it to ",
                       lists.size()));
    for (auto const& list : lists) check_numbers(at, name, list, count, things, "the mesh");
  };
  auto choose =
      [&](std::string_view name, Numbers const& lists, auto const& elements, std::string_view things) {
        check(name, lists, elements.size(), things);
        for (std::size_t p = 0; p < lists.size(); ++p)
          for (const int e : lists[p])
            for (const Index i : elements[std::size_t(e)]) put(p, i);
      };
  check("indices", indices, position.size(), "points");
  for (std::size_t p = 0; p < indices.size(); ++p)
    for (const int i : indices[p]) put(p, i);
  choose("edgeIndices", edgeIndices, edges, "edges");
  choose("triangleIndices", triangleIndices, triangles, "triangles");
  choose("quadIndices", quadIndices, quads, "quads");
  choose("tetrahedronIndices", tetrahedronIndices, tetrahedra, "tetrahedra");
  choose("hexahedronIndices", hexahedronIndices, hexahedra, "hexahedra");
  positions.assign(n + 1, {});
  indexPairs.clear();
  for (std::size_t i = 0; i < position.size(); ++i) {
    auto& points = positions[part[i]];
    indexPairs.insert(indexPairs.end(), {int(part[i]), int(points.size())});
    points.push_back(position[i]);
  }
}

}  // namespace sinew
#endif
