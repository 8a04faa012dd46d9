// SPDX-License-Identifier: BSL-1.0
// Loaders of OFF, GiD and TRIAN files, of VTK's XML, of voxels, and transformations of loaders by a matrix.
#include <sinew/engine/gid_mesh_loader.hpp>
#include <sinew/engine/mesh_off_loader.hpp>
#include <sinew/engine/mesh_trian_loader.hpp>
#include <sinew/engine/mesh_vtk_loader.hpp>
#include <sinew/engine/voxel_grid_loader.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <cstdio>
#include <fstream>

namespace test_text_mesh_loaders {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

namespace {

struct Written {
  std::string path;
  Written(std::string name, std::string const& content) : path(std::move(name)) {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~Written() { std::remove(path.c_str()); }
};

}  // namespace

TEST_CASE("an OFF file is triangles, quads and fans, with comments and colours left out") {
  const Mesh mesh =
      io::parse_off("a.off",
                    "# a comment\nOFF\n# another\n5 3 0\n0 0 0\n1 0 0 # right\n1 1 0\n0 1 0\n0.5 2 0\n"
                    "3 0 1 2 255 0 0\n4 0 1 2 3\n5 0 1 2 4 3\n");
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 4}, {0, 4, 3}});
  CHECK(mesh.quads == std::vector<Quad>{{0, 1, 2, 3}});
  CHECK_THAT(error_of([] { io::parse_off("a.off", "PLY\n"); }), Contains("a.off:1") && Contains("OFF"));
  CHECK_THAT(error_of([] { io::parse_off("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"); }),
             Contains("a.off:4") && Contains("point 1"));
  CHECK_THAT(error_of([] { io::parse_off("a.off", "OFF\n900 1 0\n0 0 0\n"); }), Contains("a.off:2"));
  CHECK_THAT(error_of([] { io::parse_off("a.off", "OFF\n1 0 0\n0 nan 0\n"); }), Contains("a.off:3"));
}

TEST_CASE("a mesh of GiD counts its points from any numbers") {
  const Mesh mesh = io::parse_gid("a.gidmsh",
                                  "MESH \"body\" dimension 3 ElemType Tetrahedra Nnode 4\nCoordinates\n"
                                  "10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\nEnd Coordinates\n\nElements\n"
                                  "1 10 20 30 40 7\nend elements\n");
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  CHECK(mesh.positions[1] == Eigen::Vector3d(1, 0, 0));
  const Mesh flat =
      io::parse_gid("a.gidmsh",
                    "mesh dimension 2 elemtype triangle nnode 6\ncoordinates\n1 0 0\n2 1 0\n3 0 1\n4 .5 0\n"
                    "5 .5 .5\n6 0 .5\nend coordinates\nelements\n1 1 2 3 4 5 6\nend elements\n");
  CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(flat.positions[4] == Eigen::Vector3d(0.5, 0.5, 0));
  CHECK_THAT(error_of([] { io::parse_gid("a", "MESH dimension 3 ElemType Prism Nnode 6\n"); }),
             Contains("\"prism\""));
  CHECK_THAT(error_of([] { io::parse_gid("a", "MESH dimension 3 ElemType Linear Nnode 4\n"); }),
             Contains("has not 4 points"));
  CHECK_THAT(error_of([] {
               io::parse_gid(
                   "a",
                   "MESH dimension 3 ElemType Linear Nnode 2\nCoordinates\n1 0 0 0\nEnd Coordinates\n"
                   "Elements\n1 1 2\nEnd Elements\n");
             }),
             Contains("a:6") && Contains("point 2 is not among"));
  CHECK_THAT(error_of([] {
               io::parse_gid("a", "MESH dimension 3 ElemType Linear Nnode 2\nCoordinates\n1 0 0 0\n");
             }),
             Contains("End Coordinates"));
}

TEST_CASE("a TRIAN file has triangles and their neighbours") {
  const Mesh mesh = io::parse_trian("a.trian", "3\n0 0 0\n1 0 0\n0 1 0\n1\n0 1 2 -1 -1 -1\n");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK_THAT(error_of([] { io::parse_trian("a.trian", "1\n0 0 0\n1\n0 0 1\n"); }), Contains("a.trian:4"));
}

TEST_CASE("VTK's XML holds polygons, too, whatever the ending") {
  const std::string xml =
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" "
      "compressor=\"vtkZLibDataCompressor\">"
      "<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\" NumberOfLines=\"1\"><Points>"
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 "
      "0</DataArray>"
      "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 1 2 "
      "3</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 7</DataArray></Polys>"
      "<Lines><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">3 0 1</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">3</DataArray></Lines></Piece></PolyData></VTKFile>";
  const Written file("test_text_mesh_loaders.vtk", xml);
  MeshVTKLoader loader{.filename = {file.path}};
  loader.update("scene");
  CHECK(loader.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(loader.quads == std::vector<Quad>{{0, 1, 2, 3}});
  CHECK(loader.edges == std::vector<Edge>{{3, 0}, {0, 1}});
  std::string other = xml;
  other.replace(other.find("PolyData"), 8, "ImageData");
  CHECK_THAT(error_of([&] { io::parse_vtk_xml("a.vtp", other); }),
             Contains("\"ImageData\"") && Contains("PolyData"));
  std::string binary = xml;
  binary.replace(binary.find("ascii"), 5, "binary");
  CHECK_THAT(error_of([&] { io::parse_vtk_xml("a.vtp", binary); }), Contains("compressed with \"vtkZLib"));
}

TEST_CASE("a matrix stands in the place of translation, rotation and sizes") {
  const Written file("test_text_mesh_loaders.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  MeshOffLoader loader{.filename = {file.path}, .translation = {9, 9, 9}};
  loader.transformation << 0, -1, 0, 5, 1, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 1;
  loader.update("scene");
  CHECK(loader.position == Points{{5, 0, 2}, {5, 1, 2}, {4, 0, 2}});
  CHECK(loader.triangles[0] == Triangle{0, 1, 2});
  loader.transformation.col(2) *= -1;  // mirrors
  loader.update("scene");
  CHECK(loader.triangles[0] == Triangle{2, 1, 0});
  loader.transformation(3, 0) = 1;
  CHECK_THAT(error_of([&] { loader.update("scene"); }), Contains("last row of transformation"));
  loader.transformation.setZero(), loader.transformation(3, 3) = 1;
  CHECK_THAT(error_of([&] { loader.update("scene"); }), Contains("would make the mesh flat"));
}

TEST_CASE("voxels of the body become hexahedra that share points, or points") {
  // 3 x 2 x 1 voxels behind two bytes
  const Written file("test_text_mesh_loaders.raw",
                     std::string("hh") + std::string("\x05\x00\x05\x00\x00\x07", 6));
  VoxelGridLoader loader{.filename = {file.path},
                         .voxelSize = {1, 2, 3},
                         .resolution = {3, 2, 1},
                         .headerSize = 2,
                         .bgValue = {0}};
  loader.update("scene");
  CHECK(loader.hexahedra.size() == 3);
  CHECK(loader.idxInRegularGrid == std::vector<int>{0, 2, 5});
  CHECK(loader.position.size() == 8 + 12);  // one alone, two with a common side
  for (auto const& h : loader.hexahedra) {
    auto x = [&](std::size_t k) { return loader.position[std::size_t(h[k])]; };
    CHECK(x(6) - x(0) == Eigen::Vector3d(1, 2, 3));
    CHECK((x(1) - x(0)).dot((x(3) - x(0)).cross(x(4) - x(0))) == 6);
  }
  loader.dataValue = {7}, loader.generateHexa = false;
  loader.update("scene");
  CHECK(loader.position == Points{{2, 2, 0}});
  loader.dataValue.clear(), loader.roi = {1, 0, 0, 9, 0, 9};
  loader.update("scene");
  CHECK(loader.idxInRegularGrid == std::vector<int>{2});
  loader.resolution = {3, 2, 2};
  CHECK_THAT(error_of([&] { loader.update("scene"); }), Contains("8 bytes, too few for 12"));
  loader.resolution = {0, 1, 1};
  CHECK_THAT(error_of([&] { loader.update("scene"); }), Contains("resolution has a 0"));
}

}  // namespace test_text_mesh_loaders
