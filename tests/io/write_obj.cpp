// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_obj.hpp>
#include <sinew/io/write_obj.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_write_obj {

using namespace sinew;
using files::check_says;

TEST_CASE("write_obj writes what read_obj reads, bit by bit") {
  const files::TempFolder folder;
  Mesh mesh = samples::mesh();
  mesh.tetrahedra.clear();
  mesh.positions[1] = {1.0 / 3, -5e-324, 1.7976931348623157e308};
  io::write_obj(folder / "a.obj", mesh);
  CHECK(io::read_obj(folder / "a.obj") == mesh);
}

TEST_CASE("write_obj writes plain lines") {
  const files::TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0.5, -1}, {1, 0, 0}, {0, 1e-9, 0}};
  mesh.edges = {{0, 1}};
  mesh.triangles = {{2, 1, 0}};
  io::write_obj(folder / "a.obj", mesh);
  CHECK(io::read_file(folder / "a.obj") == "# Sinew\nv 0 0.5 -1\nv 1 0 0\nv 0 1e-09 0\nl 1 2\nf 3 2 1\n");
}

TEST_CASE("write_obj writes nothing of a mesh that it cannot hold or that is broken") {
  const files::TempFolder folder;
  const std::string file = folder / "a.obj";
  Mesh mesh = samples::mesh();
  check_says(
      error_of([&] { io::write_obj(file, mesh); }), file, "1 tetrahedra and 0 hexahedra; write its boundary");
  mesh.tetrahedra.clear();
  mesh.triangles[0][1] = 5;
  check_says(error_of([&] { io::write_obj(file, mesh); }), file, "triangle 0 refers to point 5");
  CHECK(folder.count() == 0);
}

}  // namespace test_write_obj
