// SPDX-License-Identifier: BSL-1.0
// Here, among what needs pugixml.
#include <sinew/engine/mesh_vtk_loader.hpp>

#include "io/files.hpp"
#include "io/samples.hpp"

namespace test_mesh_vtk_loader {

using namespace sinew;

static_assert(Engine<MeshVTKLoader>);

TEST_CASE("MeshVTKLoader reads both formats of VTK") {
  const files::TempFolder folder;
  for (const std::string& file :
       {folder.write("a.vtk", samples::vtkGrid5), folder.write("b.VTU", samples::vtuAscii)}) {
    MeshVTKLoader loader{.filename = {file}, .translation = {1, 0, 0}};
    loader.update("/root");
    const Mesh expected = samples::mesh();
    REQUIRE(loader.position.size() == 5);
    CHECK(loader.position[4] == expected.positions[4] + Eigen::Vector3d(1, 0, 0));
    CHECK(loader.edges == expected.edges);
    CHECK(loader.triangles == expected.triangles);
    CHECK(loader.quads == expected.quads);
    CHECK(loader.tetrahedra == expected.tetrahedra);
  }
}

TEST_CASE("MeshVTKLoader says which file is wrong") {
  const files::TempFolder folder;
  auto said = [](std::string const& file) {
    MeshVTKLoader loader{.filename = {file}};
    return error_of([&] { loader.update("/root"); });
  };
  files::check_says(
      said(folder.write("a.vtk", "nothing")), "/root: MeshVTKLoader", "a.vtk:1: does not begin with");
  files::check_says(said(folder / "a.vtu"), "/root: MeshVTKLoader", "a.vtu: cannot be read");
}

}  // namespace test_mesh_vtk_loader
