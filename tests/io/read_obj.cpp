// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_obj.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_read_obj {

using namespace sinew;
using files::check_says;

namespace {

std::string error_in(std::string_view content) {
  return error_of([&] { io::parse_obj("f.obj", content); });
}

}  // namespace

TEST_CASE("read_obj reads lines, triangles and quads") {
  Mesh expected = samples::mesh();
  expected.tetrahedra.clear();
  const files::TempFolder folder;
  CHECK(io::read_obj(folder.write("a.obj", samples::obj)) == expected);
}

TEST_CASE("an OBJ file may have values, vertices with one coordinate") {
  const Mesh values = io::parse_obj("f", "v 0.5\nv -2  # cold\nv 3\n");
  REQUIRE(values.positions.size() == 3);
  CHECK(values.positions[1] == Eigen::Vector3d(-2, 0, 0));
  // a vertex that has lost a coordinate is a mistake
  for (auto const* wrong : {"v 0 0 0\nv 1\n", "v 1 2\n", "v\n", "v 1\nv 2 3\n", "v x\n"})
    CHECK(error_of([&] { io::parse_obj("f", wrong); }).find("coordinate") != std::string::npos);
  CHECK(error_of([&] { io::parse_obj("f", "v 1\nv 0 0 0\n"); }).find("f:2") != std::string::npos);
}

TEST_CASE("read_obj cuts polygons into fans and polylines into edges") {
  const Mesh mesh =
      io::parse_obj("f", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\nl 5 4 3\nf 2 3 1");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 2, 0}});
  CHECK(mesh.quads.empty());
  CHECK(mesh.edges == std::vector<Edge>{{4, 3}, {3, 2}});
}

TEST_CASE("read_obj counts negative numbers back from the last vertex, and forwards to later ones") {
  const Mesh mesh =
      io::parse_obj("f", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 1 2 4\nv 0 0 1\nf -1 -2 -3\n");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}, {3, 2, 1}});
}

TEST_CASE("read_obj_file reads where faces are in a texture, and their materials") {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n";
  const auto file = io::parse_obj_file("a/f.obj",
                                       head +
                                           "mtllib my.mtl\nvt 0 0\nvt 1 0 0.5\nvt 1 1\nf 1/1 2/2 3/3\n"
                                           "usemtl skin\nf 1/-3 2/-2 3/3/1 4/4 # later\nvt 0.25\n"
                                           "usemtl bone\nf 1 2//1 5/1 4 3\nusemtl skin\nf 3 2 1");
  SurfaceLooks expected;
  expected.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0.25, 0}};
  expected.triangles = {{0, 1, 2}, {-1, -1, 0}, {-1, 0, -1}, {-1, -1, -1}, {-1, -1, -1}};
  expected.quads = {{0, 1, 2, 3}};
  expected.materials = {"skin", "bone"};
  expected.faceMaterials = {-1, 1, 1, 1, 0, 0};
  expected.library = "a/my.mtl";
  CHECK(file.looks == expected);
  CHECK(file.mesh == io::parse_obj("f.obj", head + "f 1 2 3\nf 1 2 3 4\nf 1 2 5 4 3\nf 3 2 1"));
  CHECK(io::parse_obj_file("f.obj", head + "mtllib /m/my.mtl\nusemtl a\nf 1 2 3").looks.library ==
        "/m/my.mtl");
  // what no face uses is not there
  CHECK(io::parse_obj_file("f.obj", head + "vt 0 0\nmtllib my.mtl\nf 1 2 3\nusemtl a").looks ==
        SurfaceLooks{});
  // programs write numbers of what they did not write
  CHECK(io::parse_obj_file("f.obj", head + "f 1/1 2/2 3/3").looks == SurfaceLooks{});
}

TEST_CASE("read_obj takes no offence at zero bytes behind the text") {
  const std::string content = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK(io::parse_obj("f.obj", content + std::string(3, '\0')) == io::parse_obj("f.obj", content));
  check_says(error_of([&] { io::parse_obj("f.obj", content + '\0' + content); }), "f.obj:5", "the byte 0");
}

TEST_CASE("read_obj names the line of an error") {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  check_says(error_in(v + "f 1 2 4\nf 1 2 3"), "f.obj:4", "vertex 4 does not exist: there are 3");
  check_says(
      error_in(v + "f 1 2 9223372036854775807"), "f.obj:4", "vertex 9223372036854775807 does not exist");
  check_says(error_in(v + "f 1 2 -4"), "f.obj:4", "vertex -4 does not exist");
  check_says(error_in(v + "f 1 2 -9223372036854775808"), "f.obj:4", "does not exist");
  check_says(error_in(v + "f 0 1 2"), "f.obj:4", "vertex 0 does not exist");
  check_says(error_in(v + "f 1 2"), "f.obj:4", "fewer than three");
  check_says(error_in(v + "l 1 # 2"), "f.obj:4", "fewer than two");
  check_says(error_in(v + "f 1 2 3.5"), "f.obj:4", "found \"3.5\"");
  check_says(error_in(v + "f 1 2 3/x"), "f.obj:4", "found \"3/x\"");
  check_says(error_in(v + "vt 0 0\nf 1/1 2/2 3/1"),
             "f.obj:5",
             "texture coordinate 2 does not exist: there are 1 texture coordinates, numbered from 1");
  check_says(error_in(v + "vt 0 0\nf 1/0 2/1 3/1"), "f.obj:5", "texture coordinate 0 does not exist");
  check_says(error_in(v + "vt 0 0\nf 1/-2 2/1 3/1"), "f.obj:5", "texture coordinate -2 does not exist");
  check_says(error_in(v + "vt inf 0\n"), "f.obj:4", "not a finite number");
  check_says(error_in(v + "vt\n"), "f.obj:4", "expected a coordinate");
  check_says(error_in("v 0 0 0\n\nv 0 nan 0"), "f.obj:3", "not a finite number");
  check_says(error_in("v 0 0 1e999"), "f.obj:1", "not a finite number");
  check_says(error_in("v 0 0\nv 0 0 0"), "f.obj:1", "found the end of the line");
  check_says(error_in("v 0 0 # 1"), "f.obj:1", "expected a coordinate");
  check_says(error_in(v + "curv 0 1 1 2"), "f.obj:4", "found \"curv\"");
  check_says(error_in("vn 0 0 1\nf"), "f.obj:2", "fewer than three");
  check_says(error_in("# nothing\n"), "f.obj:1", "no vertices");
  check_says(error_in(v + "\x7f"
                          "ELF"),
             "f.obj:4",
             "not text");
}

}  // namespace test_read_obj
