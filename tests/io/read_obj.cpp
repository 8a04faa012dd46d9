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
