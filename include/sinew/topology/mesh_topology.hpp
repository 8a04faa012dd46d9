// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>

#include <string>
#include <vector>

namespace sinew {

/// Elements of any kind over the points of the node's state, as a file or a scene gives them.
struct MeshTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "MeshTopology";
  static constexpr std::string_view aliases =
      "Mesh PointSetTopologyContainer EdgeSetTopologyContainer TriangleSetTopologyContainer "
      "QuadSetTopologyContainer TetrahedronSetTopologyContainer HexahedronSetTopologyContainer "
      "ManifoldEdgeSetTopologyContainer ManifoldTriangleSetTopologyContainer "
      "ManifoldTetrahedronSetTopologyContainer";
  static constexpr bool mayHaveTetrahedra = true;  // it may have; who needs some says so at init

  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<Pyramid> pyramids{};
  std::vector<Prism> prisms{};
  DataFile filename{};
  std::string conversion{};

  // the lists, and more
  template <class... More>
  static constexpr auto listed(More... more) {
    using T = MeshTopology;
    return field_list(
        field("position", &T::position, "m", "points, for a state that is given none").also("points"),
        field("edges", &T::edges, "", "two points each", range::nonNegative).also("lines"),
        field("triangles", &T::triangles, "", "three points each", range::nonNegative),
        field("quads", &T::quads, "", "four points each, in the order around the quad", range::nonNegative),
        field("tetrahedra", &T::tetrahedra, "", "four points each", range::nonNegative).also("tetras"),
        field("hexahedra", &T::hexahedra, "", "eight points each, in VTK's order", range::nonNegative)
            .also("hexas"),
        field("pyramids",
              &T::pyramids,
              "",
              "five points each: the four around the base, and the apex",
              range::nonNegative),
        field("prisms",
              &T::prisms,
              "",
              "six points each: those of a triangle, and in the same order those of the opposite one",
              range::nonNegative),
        field(
            "filename", &T::filename, "", "a file (.msh, .obj, .stl, .ply, .vtk) with what is not given here")
            .also("fileTopology"),
        more...);
  }
  static constexpr auto fields() {
    return listed(field(
        "conversion",
        &MeshTopology::conversion,
        "",
        "the class of the topological mapping that makes its elements of those of the topology above, by "
        "which it follows that where it has none yet; in a scene file the mapping gives it"));
  }
  static constexpr auto outputs() { return listed(); }

  bool grows = false;  // elements may come while the scene runs

  TopologyView view() const {
    return {.positions = position,
            .edges = edges,
            .triangles = triangles,
            .quads = quads,
            .tetrahedra = tetrahedra,
            .hexahedra = hexahedra,
            .pyramids = pyramids,
            .prisms = prisms,
            .grows = grows};
  }

  /// The lists, for change: from here on they are no longer those of the file.
  ElementLists edit() {
    filename = {};
    return {&position, &edges, &triangles, &quads, &tetrahedra, &hexahedra, &pyramids, &prisms};
  }

  /// Takes from the file, if one is named, the lists that are empty. Throws Error when it cannot be read.
  void generate(std::string_view where);

  /// Throws Error at an index that the state has no point for, and at a tetrahedron that is flat or inside
  /// out.
  template <class D>
  void init(InitContext<D> const& context) const {
    const std::string where = text(context.where, ": MeshTopology");
    check_element_indices(where, view(), context.rest.size());
    check_tetrahedra<D>(where, tetrahedra, context.rest);
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/io/text_mesh_file.hpp>

namespace sinew {

SINEW_ONCE void MeshTopology::generate(std::string_view where) {
  if (filename.path.empty()) return;
  Mesh mesh;
  try {
    mesh = io::read_text_mesh(filename.path);
  } catch (Error const& error) {
    throw Error(text(where, ": MeshTopology"), error.what());
  }
  auto take = [](auto& list, auto& read) {
    if (list.empty()) list = std::move(read);
  };
  take(position, mesh.positions), take(edges, mesh.edges), take(triangles, mesh.triangles);
  take(quads, mesh.quads), take(tetrahedra, mesh.tetrahedra), take(hexahedra, mesh.hexahedra);
  take(pyramids, mesh.pyramids), take(prisms, mesh.prisms);
}

}  // namespace sinew
#endif
