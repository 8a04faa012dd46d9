// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

// One mesh, a tetrahedron on one triangle of a square with an edge and a quad, in every format that is read.
namespace samples {

inline sinew::Mesh mesh() {
  sinew::Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, -1.5}};
  m.edges = {{3, 4}};
  m.triangles = {{0, 2, 1}};
  m.quads = {{0, 1, 2, 3}};
  m.tetrahedra = {{0, 1, 2, 4}};
  return m;
}

// numbers of nodes with gaps and out of order
inline const std::string gmsh1 = R"($NOD
5
10 0 0 0
7 1 0 0
300 1 1 0
2 0 1 0
5 0.25 5e-1 -1.5
$ENDNOD
$ELM
5
1 15 0 1 1 10
2 1 1 1 2 2 5
3 2 1 1 3 10 300 7
4 3 1 1 4 10 7 300 2
9 4 1 1 4 10 7 300 5
$ENDELM
)";

inline const std::string gmsh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "the body"
$EndPhysicalNames
$Nodes
5
10 0 0 0
7 1 0 0
300 1 1 0
2 0 1 0
5 0.25 5e-1 -1.5
$EndNodes
$Elements
5
1 15 2 0 1 10
2 1 0 2 5
3 2 3 1 1 6 10 300 7
4 3 2 1 1 10 7 300 2
9 4 2 1 1 10 7 300 5
$EndElements
)";

// one node with a parametric coordinate, one with two
inline const std::string gmsh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 0 0 0
1 0 0 0 0
$EndEntities
$Nodes
4 5 2 300
0 1 0 1
10
0 0 0
1 1 1 1
7
1 0 0 0.125
2 1 1 1
300
1 1 0 0.5 0.5
3 1 0 2
2
5
0 1 0
0.25 0.5 -1.5
$EndNodes
$Elements
5 5 1 9
0 1 15 1
1 10
1 1 1 1
2 2 5
2 1 2 1
3 10 300 7
2 2 3 1
4 10 7 300 2
3 1 4 1
9 10 7 300 5
$EndElements
)";

inline const std::string obj = R"(# a comment
mtllib none.mtl
o thing
v 0 0 0
v 1 0 0 # another
v 1 1 0
v 0 1 0 1.0
v 0.25 +.5 -1.5
vt 0 0
vn 0 0 1
g part
usemtl white
s off
l 4 5
f 1/1 3/1/1 2//1
f -5 -4 -3 \
 -2
)";

inline const std::string vtkGrid3 = R"(# vtk DataFile Version 3.0
a title
ASCII
DATASET UNSTRUCTURED_GRID
FIELD FieldData 2
TIME 1 1 double
0.5
words 1 2 string
two words

POINTS 5 float
0 0 0  1 0 0
1 1 0  0 1 0  0.25 0.5 -1.5
METADATA
INFORMATION 0

CELLS 5 19
1 0
2 3 4
3 0 2 1
4 0 1 2 3
4 0 1 2 4
CELL_TYPES 5
1 3 5 9 10
POINT_DATA 5
SCALARS whatever float
)";

inline const std::string vtkGrid5 = R"(# vtk DataFile Version 5.1
a title
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0  1 0 0  1 1 0  0 1 0  0.25 0.5 -1.5
CELLS 5 13
OFFSETS vtktypeint64
0 2 5 9 13
CONNECTIVITY vtktypeint64
3 4
0 2 1
0 1 2 3
0 1 2 4
CELL_TYPES 4
3 5 9 10
)";

inline const std::string vtkPoly = R"(# vtk DataFile Version 4.2
a title
ASCII
DATASET POLYDATA
POINTS 5 float
0 0 0  1 0 0  1 1 0  0 1 0  0.25 0.5 -1.5
VERTICES 1 3
2 0 1
LINES 1 4
3 3 4 0
POLYGONS 3 15
3 0 2 1
4 0 1 2 3
5 0 1 2 3 4
TRIANGLE_STRIPS 1 6
5 0 1 2 3 4
)";

inline const std::string vtuAscii = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="5">
      <PointData></PointData>
      <Points>
        <DataArray type="Float64" NumberOfComponents="3" format="ascii">
          0 0 0  1 0 0  1 1 0
          0 1 0  0.25 0.5 -1.5
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii">
          0 3 4 0 2 1
          0 1 2 3 0 1 2 4
        </DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">1 3 6 10 14</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">1 3 5 9 10</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

// triangles alone, each with its own points
inline const std::string stl = R"(solid a thing
facet normal 0 0 1
  outer loop
    vertex 0 0 0
    vertex 1 0 0
    vertex 1 1 0
  endloop
endfacet
facet normal 0 0 1
  outer loop
    vertex -0 0e5 0.0
    vertex 1 1 0
    vertex 0 1 0
  endloop
endfacet
FACET NORMAL nan nan nan OUTER LOOP
    VERTEX 0 0 0 VERTEX 1 1 0 VERTEX .25 5e-1 -1.5
ENDLOOP ENDFACET
endsolid a thing
)";
inline const std::vector<sinew::Triangle> stlTriangles{{0, 1, 2}, {0, 2, 3}, {0, 2, 4}};

/// The same as a binary file.
inline std::string stl_binary() {
  std::string bytes(80, ' ');
  auto add = [&bytes](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
  };
  const sinew::Mesh m = mesh();
  add(std::uint32_t(stlTriangles.size()));
  for (auto const& t : stlTriangles) {
    for (int c = 0; c < 3; ++c) add(0.0f);
    for (const int i : t)
      for (const double c : m.positions[std::size_t(i)]) add(float(c));
    add(std::uint16_t(7));
  }
  return bytes;
}

}  // namespace samples
