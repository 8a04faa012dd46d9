// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A finer mesh of the same body: in each level edges are halved, triangles and quads become four, tetrahedra
/// and hexahedra eight, as subdivide() says. For studies of convergence, and coarse files.
struct MeshSubdivision {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshSubdivision";

  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  int levels = 1;

  static constexpr auto fields() {
    using E = MeshSubdivision;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("position", &E::position, "m", "points").also("points"),
        field("edges", &E::edges, "", "two points each", r).also("lines"),
        field("triangles", &E::triangles, "", "three points each", r),
        field("quads", &E::quads, "", "four points each, in the order around the quad", r),
        field("tetrahedra", &E::tetrahedra, "", "four points each", r).also("tetras"),
        field("hexahedra", &E::hexahedra, "", "eight points each, in VTK's order", r).also("hexas"),
        field("levels", &E::levels, "", "how often they are subdivided", r));
  }

  // after update
  std::vector<Eigen::Vector3d> finePosition{};
  std::vector<Edge> fineEdges{};
  std::vector<Triangle> fineTriangles{};
  std::vector<Quad> fineQuads{};
  std::vector<Tetrahedron> fineTetrahedra{};
  std::vector<Hexahedron> fineHexahedra{};

  static constexpr auto outputs() {
    using E = MeshSubdivision;
    return field_list(
        field("position", &E::finePosition, "m", "those points, then the new ones").also("points"),
        field("edges", &E::fineEdges, "", "two for each").also("lines"),
        field("triangles", &E::fineTriangles, "", "four for each"),
        field("quads", &E::fineQuads, "", "four for each"),
        field("tetrahedra", &E::fineTetrahedra, "", "eight for each").also("tetras"),
        field("hexahedra", &E::fineHexahedra, "", "eight for each").also("hexas"));
  }

  /// Throws Error as subdivide() does.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/subdivision.hpp>

#include <utility>

namespace sinew {

SINEW_ONCE void MeshSubdivision::update(std::string_view where) {
  check_fields(*this, where);
  Mesh fine;
  try {
    fine = subdivide({position, edges, triangles, quads, tetrahedra, hexahedra}, levels);
  } catch (Error const& error) {
    throw Error(text(where, ": ", className), error.what());
  }
  finePosition = std::move(fine.positions);
  fineEdges = std::move(fine.edges);
  fineTriangles = std::move(fine.triangles);
  fineQuads = std::move(fine.quads);
  fineTetrahedra = std::move(fine.tetrahedra);
  fineHexahedra = std::move(fine.hexahedra);
}

}  // namespace sinew
#endif
