// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_vtk.hpp>

#include "files.hpp"
#include "samples.hpp"

#include <bit>
#include <cmath>
#include <cstring>

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

// numbers as a binary file has them
template <class T>
std::string bytes(std::vector<T> const& numbers) {
  std::string all;
  for (const T number : numbers) {
    char b[sizeof(T)];
    std::memcpy(b, &number, sizeof(T));
    if constexpr (std::endian::native == std::endian::little) std::reverse(b, b + sizeof(T));
    all.append(b, sizeof(T));
  }
  return all;
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
  // either way round
  CHECK(one_cell(13, "0 1 2 4 5 6").prisms == std::vector<Prism>{{0, 1, 2, 4, 5, 6}});
  CHECK(one_cell(13, "4 5 6 0 1 2").prisms == std::vector<Prism>{{0, 1, 2, 4, 5, 6}});
  CHECK(one_cell(14, "0 1 3 2 8").pyramids == std::vector<Pyramid>{{0, 1, 3, 2, 8}});
  CHECK(one_cell(4, "8 1 2").edges == std::vector<Edge>{{8, 1}, {1, 2}});
  CHECK(one_cell(6, "0 1 2 3").triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(one_cell(7, "0 1 3 2").quads == std::vector<Quad>{{0, 1, 3, 2}});
  CHECK(one_cell(2, "0 1 2").triangles.empty());
  check_says(error_of([] { one_cell(26, "0 1 2 3"); }), "f:9", "cell 0 is of VTK's cell type 26");
  check_says(error_of([] { one_cell(15, "0 1 2 3"); }), "f:9", "cell type 15");
  check_says(error_of([] { one_cell(30, "0 1 2 3"); }), "f:9", "cell type 30");
  // faces and edges of second order are cut between their nodes
  CHECK(one_cell(21, "0 1 2").edges == std::vector<Edge>{{0, 2}, {2, 1}});
  CHECK(one_cell(22, "0 1 2 3 4 5").triangles ==
        std::vector<Triangle>{{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}});
  CHECK(one_cell(23, "0 1 2 3 4 5 6 7").quads == std::vector<Quad>{{4, 5, 6, 7}});
  CHECK(one_cell(28, "0 1 2 3 4 5 6 7 8").quads ==
        std::vector<Quad>{{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}});
  check_says(error_of([] { one_cell(24, "0 1 2 3 4 5 6 7 8"); }),
             "f:9",
             "has 9 points, but VTK's cell type 24 has 10");
  check_says(error_of([] { one_cell(25, "0 1 2 3 4 5 6 7"); }), "f:9", "cell type 25 has 20");
  check_says(error_of([] { one_cell(29, "0 1 2 3 4 5 6 7"); }), "f:9", "cell type 29 has 27");
  check_says(error_of([] { one_cell(-1, "0 1 2 3"); }), "f:9", "cell type -1");
  check_says(
      error_of([] { one_cell(13, "0 1 2 3 4"); }), "f:9", "has 5 points, but VTK's cell type 13 has 6");
  check_says(error_of([] { one_cell(14, "0 1 2 3 9"); }), "f:8", "point 9 is not among the 9 points");
  check_says(error_of([] { one_cell(10, "0 1 2"); }), "f:9", "has 3 points, but VTK's cell type 10 has 4");
}

TEST_CASE("read_vtk names the line of an error") {
  using samples::vtkGrid3, samples::vtkGrid5, samples::vtkPoly;
  check_says(error_with(vtkGrid3, "ASCII", "EBCDIC"), "f.vtk:3", "expected ASCII or BINARY");
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

TEST_CASE("read_vtk reads binary files, highest byte first") {
  const std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.25, 0.5, -1};
  Mesh expected;
  for (std::size_t i = 0; i < x.size(); i += 3) expected.positions.emplace_back(x[i], x[i + 1], x[i + 2]);
  expected.quads = {{0, 1, 2, 3}};
  expected.tetrahedra = {{0, 1, 2, 4}};
  // a field of a string of 3 letters, of one of 70, of 9 bits and of two shorts stands before all
  const std::string field = "FIELD FieldData 3\nnames 1 2 string\n" +
                            std::string(
                                "\xc3"
                                "abc"
                                "\x80\x46") +
                            std::string(70, 'P') + "\nflags 9 1 bit\n12\nn 1 2 short\n\n\n\n\n";
  const std::string grid = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n" + field +
                           "POINTS 5 double\n" + bytes(x) + "\nMETADATA\nINFORMATION 0\n\nCELLS 2 10\n" +
                           bytes<std::int32_t>({4, 0, 1, 2, 3, 4, 0, 1, 2, 4}) + "\nCELL_TYPES 2\n" +
                           bytes<std::int32_t>({9, 10}) + "\nPOINT_DATA 5\n\1\2";
  CHECK(io::parse_vtk("f", grid) == expected);
  const std::string layout5 = "CELLS 3 8\nOFFSETS vtktypeint64\n" + bytes<std::int64_t>({0, 4, 8}) +
                              "\nCONNECTIVITY vtktypeint64\n" + bytes<std::int64_t>({0, 1, 2, 3, 0, 1, 2, 4});
  const std::size_t list = grid.find("CELLS"), types = grid.find("\nCELL_TYPES");
  CHECK(io::parse_vtk("f", std::string(grid).replace(list, types - list, layout5)) == expected);
  // polygons, and single precision
  const std::string poly = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                           bytes<float>({0, 0, 0, 1, 0, 0, 0, 0.5f, 0}) + "POLYGONS 1 4\n" +
                           bytes<std::int32_t>({3, 0, 1, 2});
  const Mesh triangle = io::parse_vtk("f", poly);
  CHECK(triangle.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(triangle.positions[2] == Eigen::Vector3d(0, 0.5, 0));

  auto error = [&](std::string const& from, std::string const& to) {
    return error_of([&] { io::parse_vtk("f.vtk", replaced(poly, from, to)); });
  };
  check_says(error("POLYGONS 1 4", "POLYGONS 1 5"), "f.vtk:6", "16 bytes follow");
  check_says(error("POLYGONS 1 4", "POLYGONS 1 3"), "f.vtk:6", "cell 0 goes beyond");
  check_says(error("POINTS 3 float", "POINTS 3 quad"), "f.vtk:5", "of a type \"quad\"");
  check_says(error("POINTS 3 float", "POINTS 1000 float"), "f.vtk:5", "correct the number");
  check_says(
      error(bytes<std::int32_t>({3, 0, 1, 2}), bytes<std::int32_t>({3, 0, 1, -2})), "f.vtk:6", "point -2");
  check_says(error(bytes<float>({0.5f}), bytes<float>({INFINITY})), "f.vtk:5", "point 2 has a coordinate");
  // cut off anywhere, it is refused or has nothing but fewer cells
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const std::string cut = grid.substr(0, n);
    CAPTURE(n);
    if (const std::string said = error_of([&] { io::parse_vtk("f.vtk", cut); }); said.empty())
      CHECK(n >= types + 13 + 8);
  }
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
