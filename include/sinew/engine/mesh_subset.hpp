// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Part of a mesh as a mesh of its own: some points, in the order of their indices, and the elements of which
/// all points are among them.
struct MeshSubsetEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshSubsetEngine";

  std::vector<Eigen::Vector3d> inputPosition{};
  std::vector<Edge> inputEdges{};
  std::vector<Triangle> inputTriangles{};
  std::vector<Quad> inputQuads{};
  std::vector<Tetrahedron> inputTetrahedra{};
  std::vector<Hexahedron> inputHexahedra{};
  std::vector<int> indices{};

  static constexpr auto fields() {
    using E = MeshSubsetEngine;
    return field_list(
        field("inputPosition", &E::inputPosition, "m", "points of the mesh"),
        field("inputEdges", &E::inputEdges, "", "edges of the mesh", range::nonNegative),
        field("inputTriangles", &E::inputTriangles, "", "triangles of the mesh", range::nonNegative),
        field("inputQuads", &E::inputQuads, "", "quads of the mesh", range::nonNegative),
        field("inputTetrahedra", &E::inputTetrahedra, "", "tetrahedra of the mesh", range::nonNegative),
        field("inputHexahedra", &E::inputHexahedra, "", "hexahedra of the mesh", range::nonNegative),
        field("indices", &E::indices, "", "the points of the part", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  static constexpr auto outputs() {
    using E = MeshSubsetEngine;
    return field_list(field("position", &E::position, "m", "points of the part"),
                      field("edges", &E::edges, "", "edges of the part"),
                      field("triangles", &E::triangles, "", "triangles of the part"),
                      field("quads", &E::quads, "", "quads of the part"),
                      field("tetrahedra", &E::tetrahedra, "", "tetrahedra of the part"),
                      field("hexahedra", &E::hexahedra, "", "hexahedra of the part"));
  }

  /// Throws Error where an index is out of range; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

namespace sinew {

SINEW_ONCE void MeshSubsetEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = inputPosition.size();
  check_numbers(at, "indices", indices, n, "points", "the mesh");
  detail::check_indices(at, "edge", inputEdges, n);
  detail::check_indices(at, "triangle", inputTriangles, n);
  detail::check_indices(at, "quad", inputQuads, n);
  detail::check_indices(at, "tetrahedron", inputTetrahedra, n);
  detail::check_indices(at, "hexahedron", inputHexahedra, n);
  std::vector<Index> number(n, -1);  // of a point in the part
  position.clear();
  for (const int i : indices) {
    number[std::size_t(i)] = Index(position.size());
    position.push_back(inputPosition[std::size_t(i)]);
  }
  auto choose = [&](auto& chosen, auto const& all) {
    chosen.clear();
    for (auto element : all) {
      bool whole = true;
      for (Index& i : element) i = number[std::size_t(i)], whole = whole && i >= 0;
      if (whole) chosen.push_back(element);
    }
  };
  choose(edges, inputEdges), choose(triangles, inputTriangles), choose(quads, inputQuads);
  choose(tetrahedra, inputTetrahedra), choose(hexahedra, inputHexahedra);
}

}  // namespace sinew
#endif
