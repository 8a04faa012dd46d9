// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_stl.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_read_stl {

using namespace sinew;
using files::check_says;
using files::replaced;

namespace {

std::string error_in(std::string_view content) {
  return error_of([&] { io::parse_stl("f.stl", content); });
}

// a binary file with one coordinate of its second triangle replaced
std::string with_number(float value) {
  std::string bytes = samples::stl_binary();
  char raw[4];
  std::memcpy(raw, &value, 4);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + 4);
  return bytes.replace(84 + 50 + 12 + 4, 4, raw, 4);
}

}  // namespace

TEST_CASE("read_stl reads ASCII and binary files, and points in one place become one") {
  const files::TempFolder folder;
  for (const std::string& file :
       {folder.write("a.stl", samples::stl), folder.write("b.stl", samples::stl_binary())}) {
    const Mesh mesh = io::read_stl(file);
    CHECK(mesh.positions == samples::mesh().positions);
    CHECK(mesh.triangles == samples::stlTriangles);
    CHECK((mesh.edges.empty() && mesh.quads.empty() && mesh.tetrahedra.empty()));
  }
}

TEST_CASE("read_stl knows a binary file that begins as an ASCII one") {
  std::string bytes = samples::stl_binary();
  bytes.replace(0, 5, "solid");
  CHECK(io::parse_stl("f", bytes).triangles == samples::stlTriangles);
}

TEST_CASE("read_stl reads several solids and leaves out triangles that use a point twice") {
  const Mesh mesh = io::parse_stl("f", samples::stl + samples::stl);
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.triangles.size() == 6);
  const Mesh fewer = io::parse_stl("f", replaced(samples::stl, "vertex 0 1 0", "vertex 1 1 0"));
  CHECK(fewer.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(io::parse_stl("f", with_number(0)).triangles.size() == 3);
}

TEST_CASE("read_stl names the place of an error") {
  check_says(error_in("solid\nendsolid\n"), "f.stl", "has no triangle");
  check_says(error_in("solid x"), "f.stl:1", "the data end where facet or endsolid is expected");
  check_says(error_in(replaced(samples::stl, "1 1 0", "1 nan 0")), "f.stl:6", "not a finite number");
  check_says(error_in(replaced(samples::stl, "1 1 0", "1 1e400 0")), "f.stl:6", "not a finite number");
  check_says(error_in(replaced(samples::stl, "1 1 0", "1 1")), "f.stl:7", "found \"endloop\"");
  check_says(
      error_in(replaced(samples::stl, "  endloop", "vertex 2 2 2 endloop")), "f.stl:7", "expected endloop");
  check_says(
      error_in(replaced(samples::stl, "outer", "inner")), "f.stl:3", "expected outer, found \"inner\"");
  check_says(error_in(replaced(samples::stl, "facet", "face")), "f.stl:2", "expected facet or endsolid");
  check_says(
      error_in(replaced(samples::stl, "endsolid a", "more a")), "f.stl:19", "expected facet or endsolid");
  check_says(error_in(samples::stl + "more"), "f.stl:20", "expected solid");
  check_says(error_in(samples::stl.substr(0, 92)), "f.stl:6", "the data end");

  const std::string bytes = samples::stl_binary();
  check_says(error_in("nothing of the kind"), "f.stl", "19 bytes are too few");
  check_says(error_in(bytes.substr(0, 200)), "f.stl", "announces 3 triangles in 234 bytes, but has 200");
  check_says(error_in(bytes + "x"), "f.stl", "announces 3 triangles in 234 bytes, but has 235");
  check_says(
      error_in(with_number(std::numeric_limits<float>::infinity())), "f.stl", "triangle 1 has a coordinate");
  check_says(error_in(with_number(std::nanf(""))), "f.stl", "not a finite number");
  std::string none = bytes.substr(0, 84);
  none.replace(80, 4, 4, '\0');
  check_says(error_in(none), "f.stl", "has no triangle");
}

}  // namespace test_read_stl
