// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Several meshes as one: the points of all, one mesh after the other, and their elements, which count them
/// so. In scene files position1, triangles1... are of the first mesh, position2... of the second.
template <class D>
struct MergeMeshes {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "MergeMeshes";
  template <class Element>
  using Lists = std::vector<std::vector<Element>>;  // one of each mesh

  int nbMeshes = 2;
  std::vector<typename D::VecCoord> positions{};
  Lists<Edge> edgesOf{};
  Lists<Triangle> trianglesOf{};
  Lists<Quad> quadsOf{};
  Lists<Tetrahedron> tetrahedraOf{};
  Lists<Hexahedron> hexahedraOf{};

  static constexpr auto fields() {
    using M = MergeMeshes;
    return field_list(
        field("nbMeshes", &M::nbMeshes, "", "number of meshes", range::nonNegative),
        field("position1", &M::positions, "m", "points of the first mesh; position2... of the others"),
        field("edges1", &M::edgesOf, "", "edges of the first mesh", range::nonNegative),
        field("triangles1", &M::trianglesOf, "", "triangles of the first mesh", range::nonNegative),
        field("quads1", &M::quadsOf, "", "quads of the first mesh", range::nonNegative),
        field("tetrahedra1", &M::tetrahedraOf, "", "tetrahedra of the first mesh", range::nonNegative),
        field("hexahedra1", &M::hexahedraOf, "", "hexahedra of the first mesh", range::nonNegative));
  }

  // after update
  int npoints = 0;
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  static constexpr auto outputs() {
    using M = MergeMeshes;
    return field_list(field("npoints", &M::npoints, "", "number of points"),
                      field("position", &M::position, "m", "points of all meshes"),
                      field("edges", &M::edges, "", "edges of all meshes"),
                      field("triangles", &M::triangles, "", "triangles of all meshes"),
                      field("quads", &M::quads, "", "quads of all meshes"),
                      field("tetrahedra", &M::tetrahedra, "", "tetrahedra of all meshes"),
                      field("hexahedra", &M::hexahedra, "", "hexahedra of all meshes"));
  }

  /// Throws Error where there are more lists than meshes, or an element refers to a missing point of its
  /// mesh; the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<MergeMeshes>());
    const std::size_t n = std::size_t(nbMeshes);
    auto count = [&](std::string_view what, auto const& lists) {
      if (lists.size() > n)
        throw Error(at,
                    text("there are ",
                         lists.size(),
                         " lists of ",
                         what,
                         ", but nbMeshes is ",
                         n,
                         "; set it to ",
                         lists.size()));
    };
    count("points", positions);
    checkAll(at, "edge", edgesOf), count("edges", edgesOf);
    checkAll(at, "triangle", trianglesOf), count("triangles", trianglesOf);
    checkAll(at, "quad", quadsOf), count("quads", quadsOf);
    checkAll(at, "tetrahedron", tetrahedraOf), count("tetrahedra", tetrahedraOf);
    checkAll(at, "hexahedron", hexahedraOf), count("hexahedra", hexahedraOf);
    position.clear();
    std::vector<Index> first;  // point of each mesh
    for (auto const& points : positions) {
      first.push_back(Index(position.size()));
      position.insert(position.end(), points.begin(), points.end());
    }
    npoints = int(position.size());
    merge(edges, edgesOf, first), merge(triangles, trianglesOf, first), merge(quads, quadsOf, first);
    merge(tetrahedra, tetrahedraOf, first), merge(hexahedra, hexahedraOf, first);
  }

 private:
  template <class List>
  void checkAll(std::string const& at, std::string_view kind, std::vector<List> const& lists) const {
    for (std::size_t m = 0; m < lists.size(); ++m)
      detail::check_indices(
          text(at, ": mesh ", m + 1), kind, lists[m], m < positions.size() ? positions[m].size() : 0);
  }
  template <class List>
  static void merge(List& to, std::vector<List> const& lists, std::vector<Index> const& first) {
    to.clear();
    for (std::size_t m = 0; m < lists.size(); ++m)
      for (auto element : lists[m]) {
        for (Index& i : element) i += first[m];
        to.push_back(element);
      }
  }
};

}  // namespace sinew
