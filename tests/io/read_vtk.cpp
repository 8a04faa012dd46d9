// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_vtk.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_read_vtk {

using namespace sinew;
using files::check_says;
using files::replaced;

namespace {

std::string error_with(std::string const& sample, std::string_view from, std::string_view to) {
  return error_of([&] { io::parse_vtk("f.vtk", replaced(sample, from, to)); });
}
// a grid of one cell over the points 0...8
Mesh one_cell(int type, std::string const& points) {
  return io::parse_vtk("f",
                       "# vtk DataFile Version 2.0\n\nascii\ndataset unstructured_grid\npoints 9 float\n"
                       "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1 5 5 5\ncells 1 " +
                           std::to_string(1 + std::count(points.begin(), points.end(), ' ') + 1) + "\n" +
                           std::to_string(std::count(points.begin(), points.end(), ' ') + 1) + " " + points +
                           "\ncell_types 1 " + std::to_string(type));
}

}  // namespace

TEST_CASE("read_vtk reads grids in both layouts") {
  const files::TempFolder folder;
  CHECK(io::read_vtk(folder.write("a.vtk", samples::vtkGrid3)) == samples::mesh());
  CHECK(io::read_vtk(folder.write("b.vtk", samples::vtkGrid5)) == samples::mesh());
}

TEST_CASE("read_vtk reads polygonal data in both layouts") {
  Mesh expected;
  expected.positions = samples::mesh().positions;
  expected.edges = {{3, 4}, {4, 0}};
  // triangle, fan of the pentagon, strip with every second triangle turned
  expected.triangles = {{0, 2, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  expected.quads = {{0, 1, 2, 3}};
  CHECK(io::parse_vtk("f", samples::vtkPoly) == expected);
  const std::string layout5 =
      "POLYGONS 4 12\nOFFSETS vtktypeint64\n0 3 7 12\nCONNECTIVITY vtktypeint64\n"
      "0 2 1 0 1 2 3 0 1 2 3 4\n";
  CHECK(io::parse_vtk(
            "f", replaced(samples::vtkPoly, "POLYGONS 3 15\n3 0 2 1\n4 0 1 2 3\n5 0 1 2 3 4\n", layout5)) ==
        expected);
}

TEST_CASE("read_vtk brings VTK's cells into the node order of the mesh") {
  CHECK(one_cell(8, "0 1 2 3").quads == std::vector<Quad>{{0, 1, 3, 2}});
  CHECK(one_cell(11, "0 1 2 3 4 5 6 7").hexahedra == std::vector<Hexahedron>{{0, 1, 3, 2, 4, 5, 7, 6}});
  CHECK(one_cell(12, "0 1 3 2 4 5 7 6").hexahedra == std::vector<Hexahedron>{{0, 1, 3, 2, 4, 5, 7, 6}});
  CHECK(one_cell(4, "8 1 2").edges == std::vector<Edge>{{8, 1}, {1, 2}});
  CHECK(one_cell(6, "0 1 2 3").triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(one_cell(7, "0 1 3 2").quads == std::vector<Quad>{{0, 1, 3, 2}});
  CHECK(one_cell(2, "0 1 2").triangles.empty());
  check_says(error_of([] { one_cell(24, "0 1 2 3"); }), "f:9", "cell 0 is of VTK's cell type 24");
  check_says(error_of([] { one_cell(-1, "0 1 2 3"); }), "f:9", "cell type -1");
  check_says(error_of([] { one_cell(13, "0 1 2 3 4 5"); }), "f:9", "wedge");
  check_says(error_of([] { one_cell(10, "0 1 2"); }), "f:9", "has 3 points, but VTK's cell type 10 has 4");
}

TEST_CASE("read_vtk names the line of an error") {
  using samples::vtkGrid3, samples::vtkGrid5, samples::vtkPoly;
  check_says(error_with(vtkGrid3, "ASCII", "BINARY"), "f.vtk:3", "binary VTK file; export it as ASCII");
  check_says(error_with(vtkGrid3, "# vtk", "# vtx"), "f.vtk:1", "does not begin with");
  check_says(error_with(vtkGrid3, "UNSTRUCTURED_GRID", "STRUCTURED_POINTS"),
             "f.vtk:4",
             "expected UNSTRUCTURED_GRID");
  check_says(error_with(vtkGrid3, "0.25 0.5", "0.25 nan"), "f.vtk:13", "not a finite number");
  check_says(error_with(vtkGrid3, "3 0 2 1", "3 0 2 5"), "f.vtk:20", "point 5 is not among the 5 points");
  check_says(error_with(vtkGrid5, "0 2 1\n", "0 -1 1\n"), "f.vtk:12", "point -1 is not");
  check_says(error_with(vtkGrid3, "CELLS 5 19", "CELLS 5 20"), "f.vtk:22", "has 19 numbers, but 20");
  check_says(error_with(vtkGrid3, "CELL_TYPES 5", "CELL_TYPES 4"), "f.vtk:23", "4 cell types");
  check_says(error_with(vtkGrid5, "0 2 5 9 13", "0 2 5 4 13"), "f.vtk:9", "offsets rise");
  check_says(error_with(vtkGrid5, "0 2 5 9 13", "1 2 5 9 13"), "f.vtk:9", "offsets rise");
  check_says(error_with(vtkGrid5, "0 2 5 9 13", "0 2 5 9 14"), "f.vtk:9", "found 14");
  check_says(error_with(vtkGrid5, "0 2 5 9 13", "0 2 5 9 12"), "f.vtk:9", "last offset is 12");
  check_says(error_with(vtkGrid5, "CONNECTIVITY", "CONECTIVITY"), "f.vtk:10", "expected CONNECTIVITY");
  check_says(error_with(vtkPoly, "LINES 1 4\n3 3 4 0", "LINES 1 2\n1 3"), "f.vtk:10", "has 1 points");
  check_says(error_with(vtkPoly, "LINES", "CELLS"), "f.vtk:9", "expected POINTS, VERTICES");
  check_says(error_with(vtkGrid3, "POINTS 5 float\n", "POINTS 5 float\n\x05"), "f.vtk:12", "not text");
  check_says(error_with(vtkGrid3, "TIME 1 1", "TIME 1000000 1000000"), "f.vtk:6", "correct the number");
  check_says(error_of([] { io::parse_vtk("f.vtk", vtkGrid3.substr(0, vtkGrid3.find("CELLS"))); }),
             "f.vtk:17",
             "needs CELLS");
  check_says(error_of([] { io::parse_vtk("f.vtk", vtkGrid3.substr(0, vtkGrid3.find("CELL_TYPES"))); }),
             "f.vtk:23",
             "needs CELLS");
}

TEST_CASE("read_vtk takes no memory on a number's word") {
  for (const char* n : {"-5", "1000000000", "4294967296", "9223372036854775807"}) {
    const std::string number = n;
    for (auto const* sample : {&samples::vtkGrid3, &samples::vtkGrid5}) {
      check_says(error_with(*sample, "POINTS 5", "POINTS " + number),
                 sample == &samples::vtkGrid3 ? "f.vtk:11" : "f.vtk:5",
                 "correct the number");
      CHECK_FALSE(error_with(*sample, "CELLS 5", "CELLS " + number).empty());
      CHECK_FALSE(error_with(*sample, "0 1 2 4", number + " 1 2 4").empty());
    }
    check_says(
        error_with(samples::vtkGrid3, "4 0 1 2 4", number + " 0 1 2 4"), "f.vtk:22", "correct the number");
    check_says(
        error_with(samples::vtkPoly, "LINES 1 4", "LINES 1 " + number), "f.vtk:9", "correct the number");
  }
}

}  // namespace test_read_vtk
