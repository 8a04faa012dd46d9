// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <cstdint>
#include <span>

namespace sinew::io {

/// Adds a triangle or a quad; of a polygon with more corners a fan of triangles around its first, which fits
/// convex ones. Expects three points or more.
void add_polygon(Mesh& mesh, std::span<Index const> p);

void add_polyline(Mesh& mesh, std::span<Index const> p);

/// Adds the parts, between all of its nodes, of an edge of 3, a triangle of 6, or a quad of 8 or 9: corners,
/// then the middles of sides, and of all. VTK's order of these is Gmsh's.
void add_quadratic_edge(Mesh& mesh, std::span<Index const> p);
void add_quadratic_triangle(Mesh& mesh, std::span<Index const> p);
void add_quadratic_quad(Mesh& mesh, std::span<Index const> p);

/// For each node in VTK's order, which this one is in Gmsh's ("Node ordering" in its manual).
inline constexpr QuadraticTetrahedron gmshQuadraticTetrahedron{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
inline constexpr QuadraticHexahedron gmshQuadraticHexahedron{0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                             13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
inline constexpr TriquadraticHexahedron gmshTriquadraticHexahedron{
    0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};

/// The numbers of vtkCellType.h.
namespace vtk_cell {
enum : std::int64_t {
  empty = 0,
  vertex,
  polyVertex,
  line,
  polyLine,
  triangle,
  triangleStrip,
  polygon,
  pixel,
  quad,
  tetrahedron,
  voxel,
  hexahedron,
  wedge,
  pyramid,
  quadraticEdge = 21,
  quadraticTriangle,
  quadraticQuad,
  quadraticTetrahedron,
  quadraticHexahedron,
  biquadraticQuad = 28,
  triquadraticHexahedron
};
}  // namespace vtk_cell

/// Adds a cell of a VTK file to `mesh`; vertices are ignored. Returns what is wrong with the cell, or
/// nothing.
std::string add_vtk_cell(Mesh& mesh, std::int64_t type, std::span<Index const> p);

/// Turns prisms of a VTK file whose first triangle is seen from outside counter-clockwise, as VTK's manual
/// has it; those of many programs are the other way round.
void orient_wedges(Mesh& mesh);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/core/error.hpp>
#include <sinew/topology/quadratic_elements.hpp>

#include <Eigen/Geometry>
#include <algorithm>

namespace sinew::io {

SINEW_ONCE void add_polygon(Mesh& mesh, std::span<Index const> p) {
  if (p.size() == 4) {
    mesh.quads.push_back({p[0], p[1], p[2], p[3]});
  } else {
    for (std::size_t i = 2; i < p.size(); ++i) mesh.triangles.push_back({p[0], p[i - 1], p[i]});
  }
}

SINEW_ONCE void add_polyline(Mesh& mesh, std::span<Index const> p) {
  for (std::size_t i = 1; i < p.size(); ++i) mesh.edges.push_back({p[i - 1], p[i]});
}

SINEW_ONCE void add_quadratic_edge(Mesh& mesh, std::span<Index const> p) {
  mesh.edges.push_back({p[0], p[2]});
  mesh.edges.push_back({p[2], p[1]});
}

SINEW_ONCE void add_quadratic_triangle(Mesh& mesh, std::span<Index const> p) {
  for (Triangle const& t : parts_of_triangle<Index>({p[0], p[1], p[2]}, {p[3], p[4], p[5]}))
    mesh.triangles.push_back(t);
}

SINEW_ONCE void add_quadratic_quad(Mesh& mesh, std::span<Index const> p) {
  const Quad corners{p[0], p[1], p[2], p[3]}, sides{p[4], p[5], p[6], p[7]};
  if (p.size() == 9) {
    for (Quad const& q : parts_of_quad(corners, sides, p[8])) mesh.quads.push_back(q);
  } else {
    for (Triangle const& t : corner_parts_of_quad(corners, sides)) mesh.triangles.push_back(t);
    mesh.quads.push_back(sides);
  }
}

SINEW_ONCE std::string add_vtk_cell(Mesh& mesh, std::int64_t type, std::span<Index const> p) {
  struct Size {
    std::size_t minimum, maximum;
  };
  constexpr std::size_t any = std::size_t(-1);
  constexpr Size sizes[] = {{0, any}, {1, 1},   {0, any}, {2, 2}, {2, any}, {3, 3},  {3, any}, {3, any},
                            {4, 4},   {4, 4},   {4, 4},   {8, 8}, {8, 8},   {6, 6},  {5, 5},   {},
                            {},       {},       {},       {},     {},       {3, 3},  {6, 6},   {8, 8},
                            {10, 10}, {20, 20}, {},       {},     {9, 9},   {27, 27}};
  if (type < 0 || type > vtk_cell::triquadraticHexahedron ||
      (type != vtk_cell::empty && sizes[type].maximum == 0))
    return text("is of VTK's cell type ",
                type,
                ", which is not read; convert the mesh to triangles, quads, tetrahedra or hexahedra, of "
                "first or second order, or linear wedges or pyramids");
  const Size size = sizes[type];
  if (p.size() < size.minimum || p.size() > size.maximum)
    return text("has ",
                p.size(),
                " points, but VTK's cell type ",
                type,
                " has ",
                size.minimum,
                size.maximum == any ? " or more" : "",
                "; correct the cell");
  switch (type) {
    case vtk_cell::line:
    case vtk_cell::polyLine:
      add_polyline(mesh, p);
      break;
    case vtk_cell::triangle:
    case vtk_cell::polygon:
    case vtk_cell::quad:
      add_polygon(mesh, p);
      break;
    case vtk_cell::triangleStrip:  // every second triangle is reversed
      for (std::size_t i = 2; i < p.size(); ++i)
        mesh.triangles.push_back({p[i - 2], p[i - 1 + i % 2], p[i - i % 2]});
      break;
    case vtk_cell::pixel:
      mesh.quads.push_back({p[0], p[1], p[3], p[2]});
      break;
    case vtk_cell::tetrahedron:
      mesh.tetrahedra.push_back({p[0], p[1], p[2], p[3]});
      break;
    case vtk_cell::voxel:
      mesh.hexahedra.push_back({p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6]});
      break;
    case vtk_cell::hexahedron:
      mesh.hexahedra.push_back({p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
      break;
    case vtk_cell::wedge:
      mesh.prisms.push_back({p[0], p[1], p[2], p[3], p[4], p[5]});
      break;
    case vtk_cell::pyramid:
      mesh.pyramids.push_back({p[0], p[1], p[2], p[3], p[4]});
      break;
    case vtk_cell::quadraticEdge:
      add_quadratic_edge(mesh, p);
      break;
    case vtk_cell::quadraticTriangle:
      add_quadratic_triangle(mesh, p);
      break;
    case vtk_cell::quadraticQuad:
    case vtk_cell::biquadraticQuad:
      add_quadratic_quad(mesh, p);
      break;
    case vtk_cell::quadraticTetrahedron:
      std::copy(p.begin(), p.end(), mesh.quadraticTetrahedra.emplace_back().begin());
      break;
    case vtk_cell::quadraticHexahedron:
      std::copy(p.begin(), p.end(), mesh.quadraticHexahedra.emplace_back().begin());
      break;
    case vtk_cell::triquadraticHexahedron:
      std::copy(p.begin(), p.end(), mesh.triquadraticHexahedra.emplace_back().begin());
      break;
    default:
      break;
  }
  return {};
}

SINEW_ONCE void orient_wedges(Mesh& mesh) {
  auto x = [&](Index i) -> Eigen::Vector3d const& { return mesh.positions[std::size_t(i)]; };
  for (Prism& p : mesh.prisms) {
    const Eigen::Vector3d up = x(p[3]) + x(p[4]) + x(p[5]) - x(p[0]) - x(p[1]) - x(p[2]),
                          normal = (x(p[1]) - x(p[0])).cross(x(p[2]) - x(p[0])) +
                                   (x(p[4]) - x(p[3])).cross(x(p[5]) - x(p[3]));
    if (up.dot(normal) < 0) std::swap_ranges(p.begin(), p.begin() + 3, p.begin() + 3);
  }
}

}  // namespace sinew::io
#endif
