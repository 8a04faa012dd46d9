// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/grid_mesh_creator.hpp>
#include <sinew/engine/mesh_subdivision.hpp>
#include <sinew/engine/string_mesh_creator.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/subdivision.hpp>

#include "catch.hpp"
#include "topology/mesh_checks.hpp"

namespace test_made_meshes {

using namespace sinew;

TEST_CASE("StringMeshCreator makes points along x with edges between neighbours, and places them") {
  StringMeshCreator string{.resolution = 5};
  string.update("e");
  REQUIRE(string.position.size() == 5);
  for (int i = 0; i < 5; ++i) CHECK(string.position[std::size_t(i)] == Eigen::Vector3d(i / 4., 0, 0));
  CHECK(string.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  StringMeshCreator placed{.translation = {0, 0, 5}, .rotation = {0, 0, 90}, .scale3d = {2, 3, 4}};
  placed.update("e");
  placed.update("e");  // once more, as where a link asks again
  REQUIRE(placed.position.size() == 2);
  CHECK((placed.position[1] - Eigen::Vector3d(0, 2, 5)).norm() < 1e-15);
  CHECK(placed.edges.size() == 1);
  CHECK(contains(error_of([] { StringMeshCreator{.resolution = 1}.update("e"); }), "resolution is 1"));
  CHECK(contains(error_of([] { StringMeshCreator{.resolution = 1 << 25}.update("/root"); }),
                 "/root: StringMeshCreator: resolution is 33554432"));
}

TEST_CASE("GridMeshCreator makes a sheet of squares, or of triangles with the diagonals that are wanted") {
  GridMeshCreator sheet{.resolution = {4, 3}, .trianglePattern = 0};
  sheet.update("e");
  REQUIRE(sheet.position.size() == 12);
  CHECK(sheet.position[6] == Eigen::Vector3d(2. / 3, 0.5, 0));
  CHECK(sheet.quads.size() == 6);
  CHECK(sheet.quads[0] == Quad{0, 1, 5, 4});
  CHECK(sheet.triangles.empty());
  CHECK(sheet.edges.size() == 3 * 3 + 4 * 2);
  auto diagonals = [&](int pattern) {
    sheet.trianglePattern = pattern;
    sheet.update("e");
    const auto q = surface_quality({.positions = sheet.position, .triangles = sheet.triangles});
    CHECK(q.area == Approx(1));
    CHECK(q.eulerCharacteristic == 1);
    CHECK(sheet.triangles.size() == 12);
    CHECK(sheet.edges.size() == 17 + 6);
    CHECK(sheet.quads.empty());
    auto has = [&](Edge const& e) { return std::count(sheet.edges.begin(), sheet.edges.end(), e) == 1; };
    std::string signs;  // of each square, from below left up or not
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) {
        const int p = x + 4 * y;
        CHECK(has({p, p + 5}) != has({p + 1, p + 4}));
        signs += has({p, p + 5}) ? '/' : '\\';
      }
    return signs;
  };
  CHECK(diagonals(1) == "/\\/\\/\\");
  CHECK(diagonals(2) == "//////");
  CHECK(diagonals(3) == "\\\\\\\\\\\\");
  // placed as the mesh of a file
  GridMeshCreator placed{.translation = {0, 0, 5}, .rotation = {90, 0, 0}, .scale3d = {2, 3, 0}};
  placed.update("e");
  CHECK((placed.position[3] - Eigen::Vector3d(2, 0, 8)).norm() < 1e-14);
  CHECK(contains(error_of([] { GridMeshCreator{.resolution = {1, 2}}.update("e"); }), "resolution[0] is 1"));
  CHECK(
      contains(error_of([] { GridMeshCreator{.trianglePattern = 4}.update("e"); }), "trianglePattern is 4"));
  CHECK(contains(error_of([] {
                   GridMeshCreator{.resolution = {9000, 9000}}.update("e");
                 }),
                 "more than 2^24"));
}

TEST_CASE("MeshSubdivision passes on what subdivide() makes") {
  const Mesh mesh = regular_grid_tetrahedra(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  MeshSubdivision engine{.position = mesh.positions, .tetrahedra = mesh.tetrahedra, .levels = 2};
  engine.update("e");
  const Mesh fine = subdivide(mesh, 2);
  CHECK(engine.finePosition == fine.positions);
  CHECK(engine.fineTetrahedra == fine.tetrahedra);
  CHECK(engine.fineTriangles.empty());
  engine.levels = 0;
  engine.update("e");
  CHECK(engine.fineTetrahedra == mesh.tetrahedra);
  engine.tetrahedra[0][1] = 99;
  CHECK(contains(error_of([&] { engine.update("e"); }),
                 "e: MeshSubdivision: subdivide: tetrahedron 0 refers to point 99"));
  engine.levels = -1;
  CHECK(contains(error_of([&] { engine.update("e"); }), "levels is -1"));
}

}  // namespace test_made_meshes
