// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/mesh2point_topological_mapping.hpp>
#include <sinew/engine/simple_tesselated_tetra_topological_mapping.hpp>
#include <sinew/engine/topological_mapping.hpp>
#include <sinew/topology/border.hpp>
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
  surface.none = true;
  surface.update("t");
  CHECK(surface.converted.empty());
}

TEST_CASE("hexahedra become prisms that fill them, match those beside them, and lie as SOFA's") {
  const Mesh mesh = grid();
  Hexa2PrismTopologicalMapping halves{
      .position = mesh.positions, .elements = mesh.hexahedra, .flipNormals = true};
  halves.update("t");
  REQUIRE(halves.converted.size() == 2 * mesh.hexahedra.size());
  auto const& h = mesh.hexahedra[0];
  CHECK(halves.converted[0] == Prism{h[0], h[5], h[1], h[3], h[6], h[2]});
  CHECK(halves.converted[1] == Prism{h[0], h[4], h[5], h[3], h[7], h[6]});
  const Border border = border_of({}, {}, {}, halves.converted);
  // two sides of the grid are of triangles, the others of quads
  CHECK(border.triangles.size() == 2 * 2 * std::size_t((nx - 1) * (nz - 1)));
  CHECK(border.quads.size() == 2 * std::size_t((nx - 1) * (ny - 1) + (ny - 1) * (nz - 1)));
  std::vector<Triangle> surface = border.triangles;
  for (auto const& q : border.quads) surface.insert(surface.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  CHECK(volume_inside(mesh.positions, surface) == Approx(2 * 3 * 4));
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

TEST_CASE(
    "hexahedra of a grid, mirrored in turn or not, become tetrahedra that match and fill it, as SOFA cuts "
    "them") {
  for (const bool swapping : {false, true})
    for (const int across : {3, 4}) {
      const Mesh mesh = regular_grid(across, ny, nz, {0, 0, 0}, {across - 1.0, 3, 4});
      Hexa2TetraTopologicalMapping tetra{.position = mesh.positions,
                                         .elements = mesh.hexahedra,
                                         .swapping = swapping,
                                         .grid = {across, ny, nz}};
      tetra.update("t");
      double minimum = 1;
      for (Tetrahedron const& t : tetra.converted) {
        auto edge = [&](std::size_t k) -> Eigen::Vector3d {
          return mesh.positions[std::size_t(t[k])] - mesh.positions[std::size_t(t[0])];
        };
        minimum = std::min(minimum, edge(1).cross(edge(2)).dot(edge(3)) / 6);
      }
      CHECK(minimum == Approx(1.0 / 6));
      // inner faces have two tetrahedra: what is left is the surface
      const auto surface = boundary_triangles(tetra.converted);
      CHECK(surface.size() ==
            4 * std::size_t((across - 1) * (ny - 1) + (ny - 1) * (nz - 1) + (nz - 1) * (across - 1)));
      CHECK(volume_inside(mesh.positions, surface) == Approx(12.0 * (across - 1)));
      // SOFA's first tetrahedron of the first cell, which is mirrored along x with swapping
      CHECK(tetra.converted[0] == (swapping ? Tetrahedron{1, across * ny, across * ny + across, 0}
                                            : Tetrahedron{0, across * ny + 1, 1, across * ny + across + 1}));
    }
  // turned by a quarter about the line between them, neighbours would not match by it
  const Mesh two = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  auto turned = two.hexahedra;
  auto const h = turned[1];
  turned[1] = {h[3], h[2], h[6], h[7], h[0], h[1], h[5], h[4]};
  Hexa2TetraTopologicalMapping tetra{.position = two.positions, .elements = turned};
  tetra.update("t");
  CHECK(boundary_triangles(tetra.converted).size() == 20);
  CHECK(tetra.converted == hexahedra_to_tetrahedra(turned));
}

TEST_CASE("diagonals of the quads of a sheet alternate as on a chessboard, unless they shall not") {
  const Mesh mesh = regular_grid(4, 4, 2, {0, 0, 0}, {3, 3, 1});
  std::vector<Quad> sheet;
  for (Index j = 0; j < 3; ++j)
    for (Index i = 0; i < 3; ++i) {
      const Index p = i + 4 * j;
      sheet.push_back({p, p + 1, p + 5, p + 4});
    }
  for (const bool swapping : {true, false}) {
    Quad2TriangleTopologicalMapping triangles{
        .position = mesh.positions, .elements = sheet, .swapping = swapping, .grid = {4, 4, 1}};
    triangles.update("t");
    for (std::size_t q = 0; q < sheet.size(); ++q) {
      // both triangles of a quad have its diagonal, and no more in common
      auto const &a = triangles.converted[2 * q], &b = triangles.converted[2 * q + 1];
      auto on = [](Triangle const& t, Index i) { return std::find(t.begin(), t.end(), i) != t.end(); };
      const std::size_t k = swapping && (q % 3 + q / 3) % 2 == 1 ? 1 : 0;
      CHECK((on(a, sheet[q][k]) && on(b, sheet[q][k]) && on(a, sheet[q][k + 2]) && on(b, sheet[q][k + 2])));
      CHECK(on(a, sheet[q][k + 1]) != on(b, sheet[q][k + 1]));
    }
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

namespace {

double volume_of(std::vector<Eigen::Vector3d> const& x, Tetrahedron const& t) {
  auto edge = [&](std::size_t k) -> Eigen::Vector3d { return x[std::size_t(t[k])] - x[std::size_t(t[0])]; };
  return edge(1).cross(edge(2)).dot(edge(3)) / 6;
}
/// The message of what update() throws.
template <class E>
std::string wrong(E engine) {
  try {
    engine.update("t");
  } catch (Error const& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("eight tetrahedra of each fill it, match those beside them, and have its points first") {
  const Mesh mesh = grid();
  const auto large = hexahedra_to_tetrahedra(mesh.hexahedra);
  SimpleTesselatedTetraTopologicalMapping fine{.position = mesh.positions, .tetrahedra = large};
  fine.update("t");
  const auto edges = edges_of(large);
  REQUIRE(fine.finePosition.size() == mesh.positions.size() + edges.size());
  CHECK(std::equal(mesh.positions.begin(), mesh.positions.end(), fine.finePosition.begin()));
  REQUIRE(fine.fineTetrahedra.size() == 8 * large.size());
  for (std::size_t e = 0; e < fine.fineTetrahedra.size(); ++e)
    CHECK(volume_of(fine.finePosition, fine.fineTetrahedra[e]) ==
          Approx(volume_of(mesh.positions, large[e / 8]) / 8));
  // an inner face has two tetrahedra: four triangles are left of each of the surface
  const auto surface = boundary_triangles(fine.fineTetrahedra);
  CHECK(surface.size() == 4 * boundary_triangles(large).size());
  CHECK(volume_inside(fine.finePosition, surface) == Approx(24));

  // middles are in the order of the edges that are given
  SimpleTesselatedTetraTopologicalMapping ordered = fine;
  ordered.edges = edges;
  ordered.update("t");
  for (std::size_t e = 0; e < edges.size(); ++e)
    CHECK(ordered.finePosition[mesh.positions.size() + e] ==
          0.5 * (mesh.positions[std::size_t(edges[e][0])] + mesh.positions[std::size_t(edges[e][1])]));
  ordered.edges.pop_back();
  CHECK(wrong(ordered).find("is not in edges") != std::string::npos);
  CHECK(wrong(SimpleTesselatedTetraTopologicalMapping{.position = mesh.positions}).find("no tetrahedron") !=
        std::string::npos);
  fine.tetrahedra[3][1] = 1000;
  CHECK(wrong(fine).find("refers to point 1000") != std::string::npos);
}

TEST_CASE("points made of elements are where their coordinates say, kind by kind") {
  const Mesh mesh = regular_grid(3, 2, 2, {0, 0, 0}, {4, 2, 6});
  Mesh2PointTopologicalMapping all{.position = mesh.positions,
                                   .edges = {{0, 1}},
                                   .triangles = {{0, 1, 3}},
                                   .quads = {{0, 1, 4, 3}},
                                   .tetrahedra = {{0, 1, 3, 6}},
                                   .hexahedra = mesh.hexahedra,
                                   .pointBaryCoords = {{0, 0, 0}, {0, 0, 1}},
                                   .edgeBaryCoords = {{0.25, 0, 0}},
                                   .triangleBaryCoords = {{0.5, 0.25, 0}},
                                   .quadBaryCoords = {{0.25, 0.75, 0}},
                                   .tetraBaryCoords = {{0.25, 0.25, 0.25}},
                                   .hexaBaryCoords = {{0.5, 0.5, 0.5}, {0.25, 0.5, 0.75}},
                                   .copyEdges = true,
                                   .copyTriangles = true,
                                   .copyTetrahedra = true};
  all.update("t");
  auto const& x = mesh.positions;
  std::vector<Eigen::Vector3d> expected;
  for (auto const& p : x) expected.push_back(p), expected.push_back(p + Eigen::Vector3d(0, 0, 1));
  expected.insert(expected.end(),
                  {{0.5, 0, 0}, {1, 0.5, 0}, {0.5, 1.5, 0}, {0.5, 0.5, 1.5}, {1, 1, 3}, {0.5, 1, 4.5}});
  expected.insert(expected.end(), {{3, 1, 3}, {2.5, 1, 4.5}});
  REQUIRE(all.made.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK((all.made[i] - expected[i]).norm() < 1e-14);
  // each point has two, of which elements take the first
  CHECK(all.copiedEdges == std::vector<Edge>{{0, 2}});
  CHECK(all.copiedTriangles == std::vector<Triangle>{{0, 2, 6}});
  CHECK(all.copiedTetrahedra == std::vector<Tetrahedron>{{0, 2, 6, 12}});

  // edges that are not given are those of the elements, each once
  Mesh2PointTopologicalMapping middles{
      .position = x, .hexahedra = mesh.hexahedra, .edgeBaryCoords = {{0.5, 0, 0}}};
  middles.update("t");
  CHECK(middles.made.size() == edges_of(mesh.hexahedra).size());

  CHECK(wrong(Mesh2PointTopologicalMapping{.position = x}).find("makes no point") != std::string::npos);
  middles.triangleBaryCoords = {{0, 0, 0}};
  CHECK(wrong(middles).find("the topology has none") != std::string::npos);
  middles.triangleBaryCoords.clear();
  middles.copyTriangles = true;
  CHECK(wrong(middles).find("copyTriangles needs points") != std::string::npos);
  middles.hexahedra[0][2] = -1;
  CHECK_FALSE(wrong(middles).empty());
  all.edgeBaryCoords[0][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(wrong(all).find("edgeBaryCoords") != std::string::npos);
}

}  // namespace test_topological_mapping
