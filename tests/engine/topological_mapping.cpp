// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/topological_mapping.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "catch.hpp"

#include <cmath>

namespace test_topological_mapping {

using namespace sinew;

namespace {

static_assert(Engine<Hexa2TetraTopologicalMapping> && Engine<Triangle2EdgeTopologicalMapping>);

constexpr int nx = 3, ny = 4, nz = 5;  // points

Mesh grid() { return regular_grid(nx, ny, nz, {0, 0, 0}, {2, 3, 4}); }

/// Of a closed surface with its front outside, by the divergence theorem.
double volume_inside(std::vector<Eigen::Vector3d> const& x, std::vector<Triangle> const& surface) {
  double six = 0;
  for (auto const& [a, b, c] : surface)
    six += x[std::size_t(a)].dot(x[std::size_t(b)].cross(x[std::size_t(c)]));
  return six / 6;
}

}  // namespace

TEST_CASE("hexahedra become tetrahedra, their surface triangles; both enclose the same volume") {
  const Mesh mesh = grid();
  Hexa2TetraTopologicalMapping tetra{.position = mesh.positions, .elements = mesh.hexahedra};
  tetra.update("t");
  CHECK(tetra.converted.size() == 6 * std::size_t((nx - 1) * (ny - 1) * (nz - 1)));
  Tetra2TriangleTopologicalMapping surface{.position = mesh.positions, .elements = tetra.converted};
  surface.update("t");
  CHECK(volume_inside(mesh.positions, surface.converted) == Approx(2 * 3 * 4));
  surface.flipNormals = true;
  surface.update("t");
  CHECK(volume_inside(mesh.positions, surface.converted) == Approx(-2 * 3 * 4));
}

TEST_CASE("the surface of hexahedra in quads, and these in triangles") {
  const Mesh mesh = grid();
  Hexa2QuadTopologicalMapping quads{.position = mesh.positions, .elements = mesh.hexahedra};
  quads.update("t");
  CHECK(quads.converted.size() == 2 * ((nx - 1) * (ny - 1) + (ny - 1) * (nz - 1) + (nz - 1) * (nx - 1)));
  Quad2TriangleTopologicalMapping triangles{.position = mesh.positions, .elements = quads.converted};
  triangles.update("t");
  CHECK(triangles.converted.size() == 2 * quads.converted.size());
  CHECK(volume_inside(mesh.positions, triangles.converted) == Approx(2 * 3 * 4));

  SECTION("a closed surface has no border, one with a hole has the hole's") {
    Triangle2EdgeTopologicalMapping border{.position = mesh.positions, .elements = triangles.converted};
    border.update("t");
    CHECK(border.converted.empty());
    const Triangle removed = border.elements.back();
    border.elements.pop_back();
    border.update("t");
    REQUIRE(border.converted.size() == 3);
    for (auto const& edge : border.converted)
      for (const Index i : edge) CHECK(std::count(removed.begin(), removed.end(), i) == 1);
  }
}

TEST_CASE("a topological mapping says which element is wrong") {
  Quad2TriangleTopologicalMapping missing{.position = {{0, 0, 0}}, .elements = {{0, 0, 0, 7}}};
  CHECK_THROWS_WITH(missing.update("t"),
                    Catch::Contains("Quad2TriangleTopologicalMapping") && Catch::Contains("point 7"));
  Tetra2TriangleTopologicalMapping twice{.elements = {{0, 1, 2, 2}}};
  CHECK_THROWS_WITH(twice.update("t"), Catch::Contains("uses a point twice"));
  Tetra2TriangleTopologicalMapping negative{.elements = {{0, 1, 2, -2}}};
  CHECK_THROWS_AS(negative.update("t"), Error);
}

}  // namespace test_topological_mapping
