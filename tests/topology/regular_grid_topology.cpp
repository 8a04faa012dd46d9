// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/edges_as_they_come.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_regular_grid_topology {

using namespace sinew;

namespace {

RegularGridTopology made(RegularGridTopology grid) {
  grid.generate("/root");
  return grid;
}
std::string refusal(RegularGridTopology const& grid) {
  return error_of([&] { made(grid); });
}
double extent(Quad const& q, std::vector<Eigen::Vector3d> const& x) {
  auto at = [&](std::size_t k) { return x[std::size_t(q[k])]; };
  return (at(1) - at(0)).cross(at(3) - at(0)).norm();
}

}  // namespace

TEST_CASE("RegularGridTopology makes the hexahedra, quads, triangles and edges of a box") {
  const Eigen::Vector3d lo{-1, 0, 2}, hi{2, 2, 4};
  const auto grid = made({.n = {4, 3, 2}, .min = lo, .max = hi});
  const Mesh same = regular_grid(4, 3, 2, lo, hi);
  CHECK(grid.position == same.positions);
  CHECK(grid.hexahedra == same.hexahedra);
  CHECK(grid.view().grid == std::array<int, 3>{4, 3, 2});
  CHECK(grid.view().positions.size() == 24);
  CHECK(grid.view().tetrahedra.empty());

  // lines, 3 x 3 x 2 along x, 4 x 2 x 2 along y, 4 x 3 x 1 along z, and a diagonal in each square
  CHECK(grid.edges.size() == 18 + 16 + 12 + 29);
  detail::EdgesAsTheyCome sides;
  sides.add(grid.triangles, std::array<detail::EdgeCorners, 3>{{{1, 2}, {2, 0}, {0, 1}}});
  CHECK(grid.edges == sides.edges);
  auto lines = made({.n = {4, 3, 2}, .computeTriangleList = false}).edges;
  CHECK(lines.size() == 18 + 16 + 12);
  std::sort(lines.begin(), lines.end());
  CHECK(lines == edges_of(same.hexahedra));
  // squares: 3 x 2 in 2 xy planes, 3 x 1 in 3 xz planes, 2 x 1 in 4 yz planes
  REQUIRE(grid.quads.size() == 12 + 9 + 8);
  CHECK(grid.triangles.size() == 2 * grid.quads.size());
  double area = 0;
  for (Quad const& q : grid.quads) area += extent(q, grid.position);
  CHECK(area == Approx(2 * 3 * 2 + 3 * 3 * 2 + 4 * 2 * 2));
  CHECK(edges_of_quads(grid.quads) == lines);
  CHECK(grid.quads.front() == Quad{0, 1, 5, 4});
  CHECK(grid.triangles.front() == Triangle{0, 1, 5});
  CHECK(grid.triangles[1] == Triangle{0, 5, 4});
}

TEST_CASE("a grid of one plane is a sheet, of one line a string, of one point a point") {
  const auto sheet = made({.n = {3, 4, 1}, .min = {0, 0, 1}, .max = {2, 3, 9}});
  CHECK(sheet.hexahedra.empty());
  CHECK(sheet.quads.size() == 6);
  CHECK(sheet.triangles.size() == 12);
  CHECK(sheet.edges.size() == 2 * 4 + 3 * 3 + 6);
  for (auto const& n : {std::array{3, 4, 1}, {3, 1, 4}, {1, 3, 4}}) {
    const auto one = made({.n = n});
    detail::EdgesAsTheyCome sides;
    sides.add(one.triangles, std::array<detail::EdgeCorners, 3>{{{1, 2}, {2, 0}, {0, 1}}});
    CHECK(one.edges == sides.edges);
  }
  for (auto const& p : sheet.position) CHECK(p[2] == 1);  // the bottom of the box, as in SOFA

  for (const std::size_t axis : {0u, 1u, 2u}) {
    RegularGridTopology line{.n = {1, 1, 1}, .min = {0, 0, 0}, .max = {2, 2, 2}};
    line.n[axis] = 5;
    line = made(line);
    CHECK((line.quads.empty() && line.triangles.empty() && line.hexahedra.empty()));
    CHECK(line.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    // across it, in the middle of the box along x and y
    for (std::size_t c = 0; c < 3; ++c)
      if (c != axis) CHECK(line.position[0][Eigen::Index(c)] == (c == 2 ? 0 : 1));
    CHECK(line.position[4][Eigen::Index(axis)] == 2);
  }
  const auto point = made({.n = {1, 1, 1}});
  CHECK(point.position.size() == 1);
  CHECK(point.edges.empty());
  // a flat box is enough for a sheet
  CHECK(made({.n = {2, 1, 2}, .min = {0, 3, 0}, .max = {1, 3, 1}}).quads.size() == 1);
}

TEST_CASE("other ways to say where a grid is") {
  const auto old = made({.nx = 3, .ny = 2, .nz = 4, .xmin = -1, .zmin = -3, .xmax = 5, .zmax = -1});
  CHECK(old.points == std::array<int, 3>{3, 2, 4});
  CHECK(old.position.front() == Eigen::Vector3d(-1, 0, -3));
  CHECK(old.position.back() == Eigen::Vector3d(5, 1, -1));

  const auto moved =
      made({.n = {2, 2, 3}, .min = {1, 1, 1}, .max = {2, 3, 4}, .p0 = Eigen::Vector3d(-5, 0, 0)});
  CHECK(moved.position.front() == Eigen::Vector3d(-5, 0, 0));
  CHECK(moved.position.back() == Eigen::Vector3d(-4, 2, 3));

  // cells of 0.1 in a box of 0.3 x 0.25 x 0: 3, and 3 that reach beyond it, and none
  const auto cells = made({.min = {0, 0, 0}, .max = {0.3, 0.25, 0}, .cellWidth = 0.1});
  CHECK(cells.points == std::array<int, 3>{4, 4, 1});
  CHECK(cells.position.back().isApprox(Eigen::Vector3d(0.3, 0.3, 0)));
  // generating again gives the same
  auto again = cells;
  again.generate("/root");
  CHECK(again.position == cells.position);
  CHECK(again.edges == cells.edges);
}

TEST_CASE("lists that are not wanted are not made") {
  const auto bare = made({.n = {3, 3, 3},
                          .computeHexaList = false,
                          .computeQuadList = false,
                          .computeTriangleList = false,
                          .computeEdgeList = false});
  CHECK(bare.position.size() == 27);
  CHECK((bare.hexahedra.empty() && bare.quads.empty() && bare.triangles.empty() && bare.edges.empty()));
  const auto triangles = made({.n = {3, 3, 1}, .computeQuadList = false});
  CHECK(triangles.quads.empty());
  CHECK(triangles.triangles.size() == 8);
}

TEST_CASE("RegularGridTopology refuses boxes and sizes that make no sense") {
  CHECK(contains(refusal({.n = {0, 2, 2}}), "/root: RegularGridTopology: a grid of 0 x 2 x 2 points"));
  CHECK(contains(refusal({.n = {2, -7, 2}}), "at least 1 each way"));
  CHECK(contains(refusal({.n = {257, 256, 256}}), "16777216 points (2^24); make it coarser"));
  CHECK(contains(refusal({.n = {2000000000, 2000000000, 2000000000}}), "2^24"));
  CHECK(contains(refusal({.cellWidth = 1e-300}), "2^24"));
  CHECK(contains(refusal({.min = {0, 1, 0}}), "is empty"));
  CHECK(contains(refusal({.min = {0, 0, 1}}), "is empty"));
  CHECK(contains(refusal({.min = {0, 0, 2}, .cellWidth = 0.1}), "is empty"));
  CHECK(contains(refusal({.max = {1, std::nan(""), 1}}), "is empty"));
  CHECK(contains(error_of([] { check_fields(RegularGridTopology{.n = {2, 0, 2}}, "s"); }), "n[1] is 0"));
  CHECK(contains(error_of([] { check_fields(RegularGridTopology{.nx = 0}, "s"); }), "nx is 0"));
  CHECK(
      contains(error_of([] { check_fields(RegularGridTopology{.cellWidth = -1}, "s"); }), "cellWidth is -1"));
  CHECK(contains(
      error_of([] { check_fields(RegularGridTopology{.p0 = Eigen::Vector3d(0, INFINITY, 0)}, "s"); }),
      "p0 is inf"));

  const auto grid = made({.n = {3, 3, 3}});
  const std::vector<Eigen::Vector3d> few(26, Eigen::Vector3d::Zero());
  CHECK(contains(error_of([&] {
                   grid.init(InitContext<Vec3d>{"/root", few, grid.view()});
                 }),
                 "the grid has 27 points, but the state 26"));
}

}  // namespace test_regular_grid_topology
