// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Makes points of the points and elements of another topology: for each element of a kind those at the
/// coordinates that are given for the kind, in the reference element, whose corners are 0 and 1. They come
/// kind by kind, element by element. Where the topology has volumes or faces only, the edges are theirs, as
/// they come. Below a BarycentricMapping (SOFA's Mesh2PointMechanicalMapping) the points follow the elements.
struct Mesh2PointTopologicalMapping {
  using Role = role::Engine;
  static constexpr bool joinsTopologies = true;
  static constexpr std::string_view className = "Mesh2PointTopologicalMapping";
  using Coords = std::vector<Eigen::Vector3d>;

  Coords position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  Coords pointBaryCoords{}, edgeBaryCoords{}, triangleBaryCoords{}, quadBaryCoords{}, tetraBaryCoords{},
      hexaBaryCoords{};
  bool copyEdges = false, copyTriangles = false, copyTetrahedra = false;

  static constexpr auto fields() {
    using E = Mesh2PointTopologicalMapping;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("position", &E::position, "m", "points").also("points"),
        field("edges", &E::edges, "", "two points each", r).also("lines"),
        field("triangles", &E::triangles, "", "three points each", r),
        field("quads", &E::quads, "", "four points each, in the order around the quad", r),
        field("tetrahedra", &E::tetrahedra, "", "four points each", r).also("tetras"),
        field("hexahedra", &E::hexahedra, "", "eight points each, in VTK's order", r).also("hexas"),
        field("pointBaryCoords", &E::pointBaryCoords, "m", "from each point to those that are made of it"),
        field("edgeBaryCoords", &E::edgeBaryCoords, "", "places along each edge, by their first number"),
        field("triangleBaryCoords", &E::triangleBaryCoords, "", "weights of the second and third corner"),
        field("quadBaryCoords", &E::quadBaryCoords, "", "places between the sides of each quad"),
        field("tetraBaryCoords", &E::tetraBaryCoords, "", "weights of the second to fourth corner"),
        field("hexaBaryCoords", &E::hexaBaryCoords, "", "places between the faces of each hexahedron"),
        field("copyEdges", &E::copyEdges, "", "whether edges are there between the points made of points"),
        field("copyTriangles", &E::copyTriangles, "", "the same of triangles"),
        field("copyTetrahedra", &E::copyTetrahedra, "", "the same of tetrahedra"));
  }

  // after update
  Coords made{};
  std::vector<Edge> copiedEdges{};
  std::vector<Triangle> copiedTriangles{};
  std::vector<Tetrahedron> copiedTetrahedra{};

  static constexpr auto outputs() {
    using E = Mesh2PointTopologicalMapping;
    return field_list(field("position", &E::made, "m", "the points that are made").also("points"),
                      field("edges", &E::copiedEdges, "", "with copyEdges").also("lines"),
                      field("triangles", &E::copiedTriangles, "", "with copyTriangles"),
                      field("tetrahedra", &E::copiedTetrahedra, "", "with copyTetrahedra").also("tetras"));
  }

  /// Throws Error where an element has a point that is not there, coordinates are given for elements that the
  /// topology lacks, nothing is made, or elements are to be copied and no point is.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/memory_limit.hpp>
#include <sinew/topology/edges_as_they_come.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <array>

namespace sinew {

SINEW_ONCE void Mesh2PointTopologicalMapping::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  detail::check_elements(at, *this, position.size());
  made.clear(), copiedEdges.clear(), copiedTriangles.clear(), copiedTetrahedra.clear();

  // the places of one kind: weights(coords, w) fills the weight of each corner
  auto make = [&](std::string_view of, auto const& elements, Coords const& coords, auto const& weights) {
    if (coords.empty()) return;
    if (elements.empty())
      throw Error(at, text("coordinates are given for ", of, ", and the topology has none; leave them out"));
    check_memory(at,
                 text(coords.size(), " points for each of ", elements.size(), ' ', of),
                 double(coords.size()) * double(elements.size()));
    for (auto const& element : elements)
      for (Eigen::Vector3d const& c : coords) {
        std::array<double, std::tuple_size_v<std::decay_t<decltype(element)>>> w;
        weights(c, w);
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < w.size(); ++k) place += w[k] * position[std::size_t(element[k])];
        made.push_back(place);
      }
  };
  auto simplex = [](Eigen::Vector3d const& c, auto& w) {
    w[0] = 1;
    for (std::size_t k = 1; k < w.size(); ++k) {
      w[k] = c[Eigen::Index(k) - 1];
      w[0] -= w[k];
    }
  };
  for (Eigen::Vector3d const& p : position)
    for (Eigen::Vector3d const& offset : pointBaryCoords) made.push_back(p + offset);
  if (edges.empty() && !edgeBaryCoords.empty()) {
    detail::EdgesAsTheyCome all;
    all.add(tetrahedra, detail::tetrahedronEdges);
    all.add(hexahedra, detail::hexahedronEdges);
    all.add(triangles, detail::triangleSides);
    all.add(quads, detail::quadSides);
    make("edges", all.edges, edgeBaryCoords, simplex);
  } else {
    make("edges", edges, edgeBaryCoords, simplex);
  }
  make("triangles", triangles, triangleBaryCoords, simplex);
  make("quads", quads, quadBaryCoords, [](Eigen::Vector3d const& c, auto& w) {
    w = {(1 - c[0]) * (1 - c[1]), c[0] * (1 - c[1]), c[0] * c[1], (1 - c[0]) * c[1]};
  });
  make("tetrahedra", tetrahedra, tetraBaryCoords, simplex);
  make("hexahedra", hexahedra, hexaBaryCoords, [](Eigen::Vector3d const& c, auto& w) {
    for (std::size_t k = 0; k < 8; ++k) {
      w[k] = 1;
      for (std::size_t axis = 0; axis < 3; ++axis)
        w[k] *= hexahedronCorners[k][axis] == 1 ? c[Eigen::Index(axis)] : 1 - c[Eigen::Index(axis)];
    }
  });
  if (made.empty())
    throw Error(at,
                "makes no point; give coordinates, such as pointBaryCoords=\"0 0 0\" for a copy of points");

  auto copy = [&](std::string_view name, bool wanted, auto const& elements, auto& to) {
    if (!wanted) return;
    if (pointBaryCoords.empty())
      throw Error(at, text(name, " needs points made of points; give pointBaryCoords, such as 0 0 0"));
    to = elements;
    for (auto& element : to)
      for (Index& i : element) i *= Index(pointBaryCoords.size());
  };
  copy("copyEdges", copyEdges, edges, copiedEdges);
  copy("copyTriangles", copyTriangles, triangles, copiedTriangles);
  copy("copyTetrahedra", copyTetrahedra, tetrahedra, copiedTetrahedra);
}

}  // namespace sinew
#endif
