// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/mesh_file.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_mesh_file {

using namespace sinew;
using files::check_says;

TEST_CASE("read_mesh chooses by the ending of the name") {
  const files::TempFolder folder;
  const Mesh volume = samples::mesh();
  Mesh surface = volume;
  surface.tetrahedra.clear();
  CHECK(io::read_mesh(folder.write("a.msh", samples::gmsh1)) == volume);
  CHECK(io::read_mesh(folder.write("a.b.MSH", samples::gmsh4)) == volume);
  CHECK(io::read_mesh(folder.write("a.Obj", samples::obj)) == surface);
  CHECK(io::read_mesh(folder.write("a.vtk", samples::vtkGrid5)) == volume);
  CHECK(io::read_mesh(folder.write("a.vtu", samples::vtuAscii)) == volume);
}

TEST_CASE("read_mesh lists the endings that it knows") {
  const std::string known =
      "the known endings are .msh (Gmsh), .obj (Wavefront), .stl (stereolithography), .ply (Stanford), .vtk "
      "(VTK) and .vtu";
  check_says(error_of([] { io::read_mesh("a.step"); }),
             "a.step",
             "files ending in \".step\" are not read; " + known);
  check_says(error_of([] { io::read_mesh("folder.msh/a"); }),
             "folder.msh/a",
             "has no ending that tells its format; " + known);
  check_says(error_of([] { io::read_mesh("a."); }), "a.", known);
  check_says(error_of([] { io::read_mesh("missing.vtu"); }), "missing.vtu", "No such file");
}

}  // namespace test_mesh_file
