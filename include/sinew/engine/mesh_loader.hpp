// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/placement.hpp>
#include <sinew/io/read_gmsh.hpp>
#include <sinew/io/read_obj.hpp>
#include <sinew/io/read_stl.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <Eigen/LU>
#include <set>

namespace sinew {

namespace detail {

/// Appends those sides of the elements that the list has not yet, in whatever order of their points.
template <class Side, class Element, std::size_t N>
void add_sides(std::vector<Side>& list, std::vector<Element> const& elements,
               std::size_t const (&sides)[N][std::tuple_size_v<Side>]) {
  std::set<Side> known;
  auto isNew = [&](Side side) {
    std::sort(side.begin(), side.end());
    return known.insert(side).second;
  };
  for (Side const& side : list) isNew(side);
  for (Element const& element : elements)
    for (auto const& corners : sides) {
      Side side;
      for (std::size_t k = 0; k < side.size(); ++k) side[k] = element[corners[k]];
      if (isNew(side)) list.push_back(side);
    }
}

/// Unit normals at the points: the directions of the sums of unit normals of the triangles and corners of
/// quads around; zero where there is none.
std::vector<Eigen::Vector3d> point_normals(Mesh const& mesh);

/// Reverses volumes so that a mirrored mesh keeps their fronts outside.
void turn_volumes(Mesh& mesh);
/// Reverses faces, or what belongs to their corners.
void turn_faces(std::vector<Triangle>& triangles, std::vector<Quad>& quads);
/// Each quad becomes two triangles, behind those that there are, which look as it does.
void triangulate_quads(Mesh& mesh, SurfaceLooks& looks);

}  // namespace detail

/// A mesh from a file of the Format, which has a className and read(path), at the place and size that the
/// scene wants. Throws Error when the file cannot be read; what was loaded before then stays.
template <class Format>
struct MeshLoader {
  using Role = role::Engine;
  static constexpr std::string_view className = Format::className, aliases = Format::aliases,
                                    endings = Format::endings, header = Format::header;

  DataFile filename{};
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0}, scale3d{1, 1, 1};
  double scale = 1;
  Eigen::Matrix4d transformation = Eigen::Matrix4d::Identity();
  bool flipNormals = false, triangulate = false, createSubelements = false, onlyAttachedPoints = false;

  static constexpr auto fields() {
    using L = MeshLoader;
    return field_list(
        field("filename", &L::filename, "", "the file to read"),
        field("translation", &L::translation, "m", "moves the mesh, last of all"),
        field(
            "rotation", &L::rotation, "degrees", "rotates the mesh about the axes x, y and z, in this order"),
        field("scale3d", &L::scale3d, "", "sizes along the axes x, y and z, applied first"),
        field("scale", &L::scale, "", "size, beside scale3d"),
        field("transformation",
              &L::transformation,
              "",
              "4 by 4 numbers, row by row, the last of them 0 0 0 1: another one than the identity stands in "
              "the "
              "place of translation, rotation and sizes"),
        field(
            "flipNormals", &L::flipNormals, "", "whether the orientation of triangles and quads is reversed"),
        field("triangulate", &L::triangulate, "", "whether each quad becomes two triangles"),
        field("createSubelements",
              &L::createSubelements,
              "",
              "whether the faces of volumes and the edges of faces are added, where they are missing"),
        field("onlyAttachedPoints",
              &L::onlyAttachedPoints,
              "",
              "whether points that no element uses are left out"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{}, normals{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<Pyramid> pyramids{};
  std::vector<Prism> prisms{};
  std::vector<QuadraticTetrahedron> quadraticTetrahedra{};
  std::vector<QuadraticHexahedron> quadraticHexahedra{};
  std::vector<TriquadraticHexahedron> triquadraticHexahedra{};
  std::vector<Eigen::Vector2d> texcoords{};
  std::vector<Triangle> textureTriangles{};
  std::vector<Quad> textureQuads{};
  std::string materialNames{};
  std::vector<Index> faceMaterials{};
  std::string materialLibrary{};

  static constexpr auto outputs() {
    using L = MeshLoader;
    return field_list(
        field("position", &L::position, "m", "points").also("points"),
        field("normals", &L::normals, "", "unit normals of the surface at the points; zero off it"),
        field("edges", &L::edges, "", "two points each").also("lines"),
        field("triangles", &L::triangles, "", "three points each"),
        field("quads", &L::quads, "", "four points each, in the order around the quad"),
        field("tetrahedra", &L::tetrahedra, "", "four points each").also("tetras"),
        field("hexahedra", &L::hexahedra, "", "eight points each, in VTK's order").also("hexas"),
        field("pyramids", &L::pyramids, "", "five points each: those of the base, and the apex"),
        field("prisms", &L::prisms, "", "six points each: those of a triangle, and of the opposite one")
            .also("pentas pentahedra"),
        field("quadraticTetrahedra", &L::quadraticTetrahedra, "", "ten points each, in VTK's order"),
        field("quadraticHexahedra", &L::quadraticHexahedra, "", "twenty points each, in VTK's order"),
        field("triquadraticHexahedra", &L::triquadraticHexahedra, "", "27 points each, in VTK's order"),
        field("texcoords", &L::texcoords, "", "places in a texture; none where the file has none"),
        field("textureTriangles", &L::textureTriangles, "", "texcoords of the corners of each triangle"),
        field("textureQuads", &L::textureQuads, "", "texcoords of the corners of each quad"),
        field("materialNames", &L::materialNames, "", "materials of the faces"),
        field("faceMaterials", &L::faceMaterials, "", "which of them each triangle has, then each quad"),
        field("materialLibrary", &L::materialLibrary, "", "the file (.mtl) in which they are"));
  }

  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", className);
    if (filename.path.empty()) throw Error(at, "filename is empty; name the file to read");
    const bool matrix = !transformation.isIdentity(0);
    if (matrix && transformation.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      throw Error(at, "the last row of transformation is not 0 0 0 1; give a matrix that moves points");
    const Eigen::Vector3d size = matrix ? Eigen::Vector3d(1, 1, 1) : Eigen::Vector3d(scale * scale3d);
    if (matrix && transformation.topLeftCorner<3, 3>().determinant() == 0)
      throw Error(at, "transformation would make the mesh flat; give another one");
    if (size[0] == 0 || size[1] == 0 || size[2] == 0)
      throw Error(at, "scale or scale3d is 0, which would make the mesh flat; give another size");
    Mesh mesh;
    SurfaceLooks looks;
    try {
      if constexpr (requires { Format::read(filename.path).looks; }) {
        auto file = Format::read(filename.path);
        mesh = std::move(file.mesh), looks = std::move(file.looks);
      } else {
        mesh = Format::read(filename.path);
      }
    } catch (Error const& error) {
      throw Error(at, error.what());
    }

    if (triangulate) detail::triangulate_quads(mesh, looks);
    const bool mirrors = matrix ? transformation.topLeftCorner<3, 3>().determinant() < 0 : size.prod() < 0;
    if (mirrors) detail::turn_volumes(mesh);
    if (mirrors != flipNormals)
      detail::turn_faces(mesh.triangles, mesh.quads), detail::turn_faces(looks.triangles, looks.quads);
    if (createSubelements) {  // in the order of SOFA, which numbers the edges
      constexpr std::size_t ofTetrahedron[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
      constexpr std::size_t ofTriangle[3][2] = {{1, 2}, {2, 0}, {0, 1}};
      constexpr std::size_t ofQuad[4][2] = {{1, 2}, {2, 3}, {3, 0}, {0, 1}};
      detail::add_sides(mesh.quads, mesh.hexahedra, hexahedronFaces);
      detail::add_sides(mesh.quads, mesh.pyramids, pyramidQuads);
      detail::add_sides(mesh.quads, mesh.prisms, prismQuads);
      detail::add_sides(mesh.quads, mesh.quadraticHexahedra, quadraticFaces.hexahedronQuads);
      detail::add_sides(mesh.quads, mesh.triquadraticHexahedra, quadraticFaces.triquadraticQuads);
      detail::add_sides(mesh.triangles, mesh.tetrahedra, ofTetrahedron);
      detail::add_sides(mesh.triangles, mesh.pyramids, pyramidTriangles);
      detail::add_sides(mesh.triangles, mesh.prisms, prismTriangles);
      detail::add_sides(mesh.triangles, mesh.quadraticTetrahedra, quadraticFaces.tetrahedron);
      detail::add_sides(mesh.triangles, mesh.quadraticHexahedra, quadraticFaces.hexahedronTriangles);
      detail::add_sides(mesh.edges, mesh.quads, ofQuad);
      detail::add_sides(mesh.edges, mesh.triangles, ofTriangle);
    }
    if (onlyAttachedPoints) remove_unused_points(mesh);
    Placement placed = placement(translation, rotation, size);
    if (matrix) placed = {transformation.topLeftCorner<3, 3>(), transformation.topRightCorner<3, 1>()};
    for (auto& p : mesh.positions) p = placed * p;

    normals = detail::point_normals(mesh);
    position = std::move(mesh.positions);
    edges = std::move(mesh.edges);
    triangles = std::move(mesh.triangles);
    quads = std::move(mesh.quads);
    tetrahedra = std::move(mesh.tetrahedra);
    hexahedra = std::move(mesh.hexahedra);
    pyramids = std::move(mesh.pyramids);
    prisms = std::move(mesh.prisms);
    quadraticTetrahedra = std::move(mesh.quadraticTetrahedra);
    quadraticHexahedra = std::move(mesh.quadraticHexahedra);
    triquadraticHexahedra = std::move(mesh.triquadraticHexahedra);
    texcoords = std::move(looks.texcoords);
    textureTriangles = std::move(looks.triangles);
    textureQuads = std::move(looks.quads);
    materialNames = words_of_names(looks.materials);
    faceMaterials = std::move(looks.faceMaterials);
    materialLibrary = std::move(looks.library);
  }
};

namespace detail {
// beside its className and read(path), a format says other names of its loader, the endings of its files, and
// the header of the loader, where sinew.hpp does not have it
struct GmshFormat {
  static constexpr std::string_view className = "MeshGmshLoader", aliases = "", endings = ".msh", header = "";
  static Mesh read(std::string const& path) { return io::read_gmsh(path); }
};
struct ObjFormat {
  static constexpr std::string_view className = "MeshOBJLoader", aliases = "MeshObjLoader", endings = ".obj",
                                    header = "";
  static io::ObjFile read(std::string const& path) { return io::read_obj_file(path); }
};
struct StlFormat {
  static constexpr std::string_view className = "MeshSTLLoader", aliases = "", endings = ".stl", header = "";
  static Mesh read(std::string const& path) { return io::read_stl(path); }
};
}  // namespace detail

/// Reads a mesh from a Gmsh file (.msh, version 2 or 4.1).
using MeshGmshLoader = MeshLoader<detail::GmshFormat>;
/// Reads a surface from a Wavefront OBJ file (.obj).
using MeshOBJLoader = MeshLoader<detail::ObjFormat>;
/// Reads a surface of triangles from an STL file (.stl), whose equal corners become one point.
using MeshSTLLoader = MeshLoader<detail::StlFormat>;

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew::detail {

SINEW_ONCE std::vector<Eigen::Vector3d> point_normals(Mesh const& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.positions.size(), Eigen::Vector3d::Zero());
  auto add = [&](Index at, Index before, Index i, Index after) {
    auto x = [&](Index k) { return mesh.positions[std::size_t(k)]; };
    normals[std::size_t(at)] += (x(after) - x(i)).cross(x(before) - x(i)).stableNormalized();
  };
  for (auto const& t : mesh.triangles)
    for (const Index i : t) add(i, t[2], t[0], t[1]);
  for (auto const& q : mesh.quads)
    for (std::size_t k = 0; k < 4; ++k) add(q[k], q[(k + 3) % 4], q[k], q[(k + 1) % 4]);
  for (auto& n : normals) n.stableNormalize();
  return normals;
}

SINEW_ONCE void turn_volumes(Mesh& mesh) {
  for (auto& t : mesh.tetrahedra) std::swap(t[2], t[3]);
  for (auto& h : mesh.hexahedra) std::swap_ranges(h.begin(), h.begin() + 4, h.begin() + 4);
  for (auto& p : mesh.pyramids) std::swap(p[1], p[3]);
  for (auto& p : mesh.prisms) std::swap_ranges(p.begin(), p.begin() + 3, p.begin() + 3);
  for (auto& e : mesh.quadraticTetrahedra) turn_inside_out(e);
  for (auto& e : mesh.quadraticHexahedra) turn_inside_out(e);
  for (auto& e : mesh.triquadraticHexahedra) turn_inside_out(e);
}
SINEW_ONCE void turn_faces(std::vector<Triangle>& triangles, std::vector<Quad>& quads) {
  for (auto& t : triangles) std::reverse(t.begin(), t.end());
  for (auto& q : quads) std::reverse(q.begin(), q.end());
}
SINEW_ONCE void triangulate_quads(Mesh& mesh, SurfaceLooks& looks) {
  if (!looks.faceMaterials.empty()) {
    const auto before = looks.faceMaterials;
    looks.faceMaterials.resize(mesh.triangles.size());
    for (std::size_t f = mesh.triangles.size(); f < before.size(); ++f)
      looks.faceMaterials.insert(looks.faceMaterials.end(), 2, before[f]);
  }
  auto cut = [](std::vector<Triangle>& triangles, std::vector<Quad>& quads) {
    for (auto const& [a, b, c, d] : quads) triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    quads.clear();
  };
  cut(mesh.triangles, mesh.quads), cut(looks.triangles, looks.quads);
}

}  // namespace sinew::detail
#endif
