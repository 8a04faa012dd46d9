// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/box_roi.hpp>
#include <sinew/engine/plane_roi.hpp>
#include <sinew/engine/sphere_roi.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_rois {

using namespace sinew;

namespace {

static_assert(Engine<BoxROI<Vec3d>> && Engine<BoxROI<Vec1f>> && Engine<SphereROI<Rigid2d>> &&
              Engine<PlaneROI<Vec6d>>);

bool contains(std::string_view whole, std::string_view part) { return whole.find(part) != whole.npos; }

RegularGridTopology grid() {  // 5 x 4 x 3 points, one apart
  RegularGridTopology g{.n = {5, 4, 3}, .min = {0, 0, 0}, .max = {4, 3, 2}};
  g.generate("");
  return g;
}

}  // namespace

TEST_CASE("BoxROI chooses the points in a box, its faces included") {
  const auto g = grid();
  BoxROI<Vec3d> box{.box = {{0.5, 1, -1, 2, 2.5, 1}}, .position = g.position};
  box.update("box");
  std::vector<int> expected;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    auto const& p = g.position[i];
    if (p[0] >= 0.5 && p[0] <= 2 && p[1] >= 1 && p[1] <= 2.5 && p[2] <= 1) expected.push_back(int(i));
  }
  CHECK(box.indices == expected);
  CHECK(box.nbIndices == 2 * 2 * 2);
  CHECK(box.indicesOut.size() == 60 - 8);
  REQUIRE(box.pointsInROI.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) CHECK(box.pointsInROI[i] == g.position[std::size_t(expected[i])]);

  // corners in any order, and two boxes that overlap hold each point once
  BoxROI<Vec3d> two{.box = {{2, 2.5, 1, 0.5, 1, -1}, {0.5, 1, -1, 2, 2.5, 1}}, .position = g.position};
  two.update("box");
  CHECK(two.indices == expected);
  // updating again starts afresh
  two.update("box");
  CHECK(two.indices == expected);
  two.box = {{7, 7, 7, 8, 8, 8}};
  two.update("box");
  CHECK((two.indices.empty() && two.pointsInROI.empty() && two.nbIndices == 0));
}

TEST_CASE("a piece of a plane without depth is the whole plane; a box on a line an interval") {
  const auto g = grid();
  PlaneROI<Vec3d> plane{.plane = {Vec<double, 10>{{2, 0, 1, 0, 0, 1, 0, 2, 1, 0}}}, .position = g.position};
  plane.update("plane");
  CHECK(plane.nbIndices == 5 * 4);
  for (auto const& p : plane.pointsInROI) CHECK(p[2] == 1);
  for (auto& p : plane.position) p[2] += 1e-6;
  plane.update("plane");
  CHECK(plane.nbIndices == 0);
  plane.plane[0][9] = -1;
  CHECK(contains(error_of([&] { plane.update("p"); }), "depth of a box is -1, but must be 0 or greater"));

  BoxROI<Vec1d> line{.box = {{-0.1, -9, -9, 2, 9, 9}}};
  for (int i = 0; i < 5; ++i) line.position.push_back(Vec1d::Coord(i));
  line.update("line");
  CHECK(line.indices == std::vector<int>{0, 1, 2});
}

TEST_CASE("elements are chosen with all points inside, or with their mean inside") {
  const auto g = grid();
  const auto tetrahedra = hexahedra_to_tetrahedra(g.hexahedra);
  BoxROI<Vec3d> box{.box = {{-0.1, -0.1, -0.1, 2.1, 1.1, 1.1}},
                    .position = g.position,
                    .edges = g.edges,
                    .triangles = g.triangles,
                    .quads = g.quads,
                    .tetrahedra = tetrahedra,
                    .hexahedra = g.hexahedra};
  box.update("box");
  // a block of 3 x 2 x 2 points
  CHECK(box.hexahedronIndices == std::vector<int>{0, 1});
  CHECK(box.hexahedraInROI == std::vector<Hexahedron>{g.hexahedra[0], g.hexahedra[1]});
  CHECK(box.tetrahedronIndices.size() == 12);
  CHECK(box.tetrahedraInROI[5] == tetrahedra[5]);
  CHECK(box.edgeIndices.size() == 2 * 2 * 2 + 3 * 2 + 3 * 2 + box.quadIndices.size());  // and diagonals
  CHECK(box.edgesInROI.front() == g.edges.front());
  CHECK(box.quadIndices.size() == 2 * 2 + 2 * 2 + 3);
  CHECK(box.triangleIndices.size() == 2 * box.quadIndices.size());
  CHECK(box.trianglesInROI.size() == box.triangleIndices.size());
  CHECK(box.quadInROI.size() == box.quadIndices.size());

  // means of cells are at halves: a smaller box has the same two cells, and no point at all
  box.strict = false;
  box.box = {{0.4, 0.4, 0.4, 1.6, 0.6, 0.6}};
  box.update("box");
  CHECK(box.indices.empty());
  CHECK(box.hexahedronIndices == std::vector<int>{0, 1});
  CHECK(box.edgesInROI == std::vector<Edge>{{1, 26}});  // the diagonal of the square between the cells

  box.computeHexahedra = box.computeTetrahedra = false;
  box.update("box");
  CHECK((box.hexahedronIndices.empty() && box.hexahedraInROI.empty() && box.tetrahedronIndices.empty()));
}

TEST_CASE("oriented boxes and planes hold a thick parallelogram") {
  const auto g = grid();
  // the plane z = 1, over x from 1 to 3 along a slanted side: p0 (1,0), p1 (3,0), p2 (4,3)
  const Vec<double, 10> slanted{{1, 0, 1, 3, 0, 1, 4, 3, 1, 0.2}};
  BoxROI<Vec3d> box{.orientedBox = {slanted}, .position = g.position};
  PlaneROI<Vec3d> plane{.plane = {slanted}, .position = g.position};
  box.update("box"), plane.update("plane");
  std::vector<int> expected;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    auto const& p = g.position[i];
    const double along = p[0] - p[1] / 3;
    if (p[2] == 1 && along >= 1 - 1e-9 && along <= 3 + 1e-9) expected.push_back(int(i));
  }
  CHECK(expected.size() == 3 + 2 + 2 + 3);
  CHECK(box.indices == expected);
  CHECK(plane.indices == expected);
  // a depth of two reaches the planes on either side
  plane.plane[0][9] = 2;
  plane.update("plane");
  CHECK(plane.nbIndices == 30);
}

TEST_CASE("SphereROI chooses the points in spheres") {
  const auto g = grid();
  SphereROI<Vec3d> sphere{
      .centers = {{0, 0, 0}, {4, 3, 2}}, .radii = {1}, .position = g.position, .edges = g.edges};
  sphere.update("sphere");
  CHECK(sphere.indices == std::vector<int>{0, 1, 5, 20, 39, 54, 58, 59});
  CHECK(sphere.edgeIndices.size() == 6);
  sphere.radii = {0.5, 100};
  sphere.update("sphere");
  CHECK(sphere.nbIndices == 60);
  sphere.radii = {0, 0.5};
  sphere.update("sphere");
  CHECK(sphere.indices == std::vector<int>{0, 59});
}

TEST_CASE("regions over other DataTypes look at places only") {
  BoxROI<Vec2d> plane{.box = {{0, 0, 5, 1, 1, 6}}, .position = {{0.5, 0.5}, {2, 0}}};
  plane.update("box");
  CHECK(plane.indices == std::vector<int>{0});
  BoxROI<Rigid3d> rigid{.box = {{0, 0, 0, 1, 1, 1}},
                        .position = {{.center = {2, 0, 0}}, {.center = {1, 1, 1}}}};
  rigid.update("box");
  CHECK(rigid.indices == std::vector<int>{1});
  CHECK(rigid.pointsInROI[0].center == Eigen::Vector3d(1, 1, 1));
  BoxROI<Vec6d> six{.box = {{0, 0, 0, 1, 1, 1}},
                    .position = {Vec6d::Coord::Constant(0.5), Vec6d::Coord::Ones() * 2}};
  six.update("box");
  CHECK(six.indices == std::vector<int>{0});
  SphereROI<Vec1f> line{
      .centers = {{3, 9, 9}}, .radii = {1}, .position = {Vec1f::Coord(2.5f), Vec1f::Coord(1.5f)}};
  line.update("sphere");
  CHECK(line.indices == std::vector<int>{0});
}

TEST_CASE("regions say what is wrong, and keep what they had") {
  const auto g = grid();
  BoxROI<Vec3d> good{.box = {{0, 0, 0, 1, 1, 1}}, .position = g.position};
  good.update("");
  auto refused = [&](auto change, std::string_view words) {
    BoxROI<Vec3d> box = good;
    change(box);
    const std::string said = error_of([&] { box.update("/root/roi"); });
    INFO(said);
    CHECK(contains(said, "/root/roi: BoxROI<Vec3d>: "));
    CHECK(contains(said, words));
    CHECK(box.indices == good.indices);
    CHECK(box.nbIndices == 8);
  };
  refused([](auto& b) { b.position.clear(); }, "position is empty");
  refused([](auto& b) { b.box.clear(); }, "there is no box");
  refused([](auto& b) { b.box[0][4] = std::nan(""); }, "box[0] is nan m");
  refused([](auto& b) { b.position[7][1] = INFINITY; }, "position[7] is inf");
  refused(
      [](auto& b) {
        b.triangles = {{0, 1, 60}};
      },
      "triangle 0 refers to point 60, but there are 60 points");
  refused([](auto& b) { b.quads = {{0, 1, 2, 60}}; }, "quad 0 refers to point 60");
  refused([](auto& b) { b.edges = {{-1, 0}}; }, "edges[0][0] is -1");
  refused([](auto& b) { b.tetrahedra = {{0, 1, 2, 99}}; }, "tetrahedron 0 refers to point 99");
  refused([](auto& b) { b.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 99}}; }, "hexahedron 0 refers to point 99");
  refused([](auto& b) { b.orientedBox = {Vec<double, 10>{{0, 0, 0, 1, 1, 1, 3, 3, 3, 1}}}; }, "on a line");
  refused(
      [](auto& b) {
        b.orientedBox = {Vec<double, 10>{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0}}};
      },
      "depth of a box is 0, but must be greater than 0");

  auto sphere = [&](std::vector<Eigen::Vector3d> centers, std::vector<double> radii) {
    SphereROI<Vec3d> s{.centers = centers, .radii = radii, .position = g.position};
    return error_of([&] { s.update("s"); });
  };
  CHECK(contains(sphere({}, {1}), "there is no sphere"));
  CHECK(contains(sphere({{0, 0, 0}}, {}), "radii has 0 values for 1 centers"));
  CHECK(contains(sphere({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2}), "radii has 2 values for 3 centers"));
  CHECK(contains(sphere({{0, 0, 0}}, {-1}), "radii[0] is -1 m"));
  CHECK(
      contains(error_of([&] { PlaneROI<Vec3d>{.position = g.position}.update("p"); }), "there is no plane"));
  CHECK(contains(error_of([&] {
                   BoxROI<Vec2d>{.orientedBox = {Vec<double, 10>::Ones()}, .position = {{0, 0}}}.update("b");
                 }),
                 "orientedBox is for points in space"));
}

}  // namespace test_rois
