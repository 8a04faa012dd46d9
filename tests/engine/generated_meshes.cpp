// SPDX-License-Identifier: BSL-1.0
// Meshes that engines make: grids, cylinders, balls, extrusions, spirals, points inside, closed holes,
// lattices.
#include <sinew/engine/extrude_edges.hpp>
#include <sinew/engine/extrude_quads.hpp>
#include <sinew/engine/extrude_surface.hpp>
#include <sinew/engine/generate_cylinder.hpp>
#include <sinew/engine/generate_grid.hpp>
#include <sinew/engine/generate_sphere.hpp>
#include <sinew/engine/mesh_closing.hpp>
#include <sinew/engine/mesh_tetra_stuffing.hpp>
#include <sinew/engine/random_point_distribution.hpp>
#include <sinew/engine/spiral.hpp>
#include <sinew/engine/volume_from_triangles.hpp>
#include <sinew/engine/volume_from_volumetric_elements.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace test_generated_meshes {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

namespace {

static_assert(Engine<GenerateGrid> && Engine<GenerateCylinder> && Engine<GenerateSphere> &&
              Engine<ExtrudeSurface> && Engine<ExtrudeEdgesAndGenerateQuads> &&
              Engine<ExtrudeQuadsAndGenerateHexas> && Engine<Spiral> && Engine<MeshClosingEngine> &&
              Engine<RandomPointDistributionInSurface> && Engine<MeshTetraStuffing>);

double volume(Points const& x, std::vector<Tetrahedron> const& all) {
  double sum = 0;
  for (auto const& t : all) {
    auto at = [&](std::size_t k) { return x[std::size_t(t[k])]; };
    const double one = (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0))) / 6;
    CHECK(one > 0);
    sum += one;
  }
  return sum;
}
double inside(Points const& x, std::vector<Triangle> const& triangles) {
  VolumeFromTriangles<Vec3d> engine{.position = x, .triangles = triangles};
  engine.update("scene");
  return engine.volume;
}
bool closed(std::vector<Triangle> const& triangles) {
  std::map<Edge, int> uses;
  for (auto const& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  return std::all_of(uses.begin(), uses.end(), [&](auto const& u) {
    return u.second == 1 && uses.count({u.first[1], u.first[0]}) == 1;
  });
}

}  // namespace

TEST_CASE("a block of cells has the volume between its corners, as hexahedra and as tetrahedra") {
  GenerateGrid grid{.min = {-1, 0, 1}, .max = {1, 3, 2}, .resolution = {4, 3, 2}};
  grid.update("scene");
  CHECK(grid.position.size() == 5 * 4 * 3);
  CHECK(grid.position[1] == Eigen::Vector3d(-0.5, 0, 1));
  CHECK(grid.position[5] == Eigen::Vector3d(-1, 1, 1));
  CHECK(grid.hexahedra.size() == 24);
  CHECK(grid.tetrahedra.size() == 6 * 24);
  CHECK(volume(grid.position, grid.tetrahedra) == Approx(6));
  VolumeFromVolumetricElements<Vec3d> measure{.position = grid.position, .hexahedra = grid.hexahedra};
  measure.update("scene");
  CHECK(measure.volume == Approx(6));
  // cells are numbered z fastest, as in SOFA
  CHECK(grid.hexahedra[1][0] == 20);
}

TEST_CASE("without cells along z a grid is a sheet, whose triangles have its area") {
  GenerateGrid grid{.max = {2, 3, 9}, .resolution = {4, 3, 0}};
  grid.update("scene");
  CHECK(grid.position.size() == 20);
  CHECK(grid.position.back() == Eigen::Vector3d(2, 3, 0));
  CHECK(grid.quads.size() == 12);
  double area = 0;
  for (auto const& [a, b, c] : grid.triangles) {
    auto at = [&](Index i) { return grid.position[std::size_t(i)]; };
    area += (at(b) - at(a)).cross(at(c) - at(a))[2] / 2;
  }
  CHECK(area == Approx(6));
  CHECK(grid.hexahedra.empty());
}

TEST_CASE("a cylinder has the volume of its prism over a polygon, and its closed surface the same") {
  const int n = 7;
  GenerateCylinder c{.radius = 0.5,
                     .height = 2,
                     .origin = {1, 2, 3},
                     .openSurface = false,
                     .resCircumferential = n,
                     .resRadial = 3,
                     .resHeight = 4};
  c.update("scene");
  const double base = n / 2. * 0.25 * std::sin(2 * std::numbers::pi / n);
  CHECK(c.position.size() == (n * 3 + 1) * 4);
  CHECK(volume(c.position, c.tetrahedra) == Approx(2 * base));
  CHECK(c.surfacePosition.size() == std::size_t(n * (4 + 2 * 2) + 2));
  CHECK(closed(c.triangles));
  CHECK(inside(c.surfacePosition, c.triangles) == Approx(2 * base));
  c.openSurface = true;
  c.update("scene");
  CHECK(c.triangles.size() == 2 * n * 3);
  CHECK_FALSE(closed(c.triangles));
  CHECK(c.position.back()[2] == Approx(5));
}

TEST_CASE("a ball is divided as its degree says, and its volume comes near to that of the sphere") {
  struct Solid {
    PlatonicSolid solid;
    std::size_t sides, corners;
    double volume;  // of the solid in the unit sphere
  };
  const double edge = 1 / std::sin(2 * std::numbers::pi / 5);  // of the icosahedron
  for (Solid const& s :
       {Solid{PlatonicSolid::tetrahedron, 4, 4, 8 / (9 * std::sqrt(3.))},
        Solid{PlatonicSolid::octahedron, 8, 6, 4 / 3.},
        Solid{PlatonicSolid::icosahedron, 20, 12, 5 * (3 + std::sqrt(5.)) / 12 * std::pow(edge, 3)}}) {
    GenerateSphere ball{.radius = 1, .platonicSolid = s.solid};
    ball.update("scene");
    CHECK(ball.triangles.size() == s.sides);
    CHECK(ball.surfacePosition.size() == s.corners);
    CHECK(closed(ball.triangles));
    CHECK(volume(ball.position, ball.tetrahedra) == Approx(s.volume));
    ball.tessellationDegree = 8;
    ball.radius = 0.2, ball.origin = {1, 0, 0};
    ball.update("scene");
    CHECK(ball.triangles.size() == 64 * s.sides);
    CHECK(ball.surfacePosition.size() == 32 * s.sides + 2);  // Euler: V = E - F + 2
    CHECK(closed(ball.triangles));
    for (auto const& x : ball.surfacePosition) CHECK((x - ball.origin).norm() == Approx(0.2));
    const double sphere = 4 / 3. * std::numbers::pi * 0.008;
    CHECK(volume(ball.position, ball.tetrahedra) == Approx(sphere).epsilon(s.sides == 4 ? 0.07 : 0.03));
  }
}

TEST_CASE("a square of a surface, extruded, is a closed block") {
  GenerateGrid sheet{.max = {2, 3, 0}, .resolution = {2, 3, 0}};
  sheet.update("scene");
  ExtrudeSurface e{.surfaceVertices = sheet.position,
                   .triangles = sheet.triangles,
                   .surfaceTriangles = {0, 1, 2, 3},
                   .heightFactor = 0.5};
  e.update("scene");
  CHECK(e.extrusionVertices.size() == 2 * 6);
  CHECK(closed(e.extrusionTriangles));
  CHECK(inside(e.extrusionVertices, e.extrusionTriangles) == Approx(2 * 0.5));
  e.surfaceTriangles = {12};
  CHECK_THAT(error_of([&] { e.update("scene"); }),
             Contains("scene: ExtrudeSurface: surfaceTriangles has 12") && Contains("12 triangles"));
  CHECK(e.extrusionVertices.size() == 12);
}

TEST_CASE("quads become hexahedra between two thicknesses") {
  GenerateGrid sheet{.max = {2, 3, 0}, .resolution = {2, 3, 0}};
  sheet.update("scene");
  ExtrudeQuadsAndGenerateHexas e{.scale = {2, 1, 1},
                                 .thicknessIn = 0.25,
                                 .thicknessOut = 1,
                                 .numberOfSlices = 5,
                                 .flipNormals = true,
                                 .surfaceVertices = sheet.position,
                                 .surfaceQuads = sheet.quads};
  e.update("scene");
  CHECK(e.extrudedVertices.size() == 12 * 6);
  CHECK(e.extrudedVertices[0] == Eigen::Vector3d(0, 0, -0.25));
  CHECK(e.extrudedVertices[5][2] == Approx(1));
  CHECK(e.extrudedHexas.size() == 6 * 5);
  CHECK(e.extrudedQuads.size() == 6 * (2 * 5 + 4 * 5));
  VolumeFromVolumetricElements<Vec3d> measure{.position = e.extrudedVertices, .hexahedra = e.extrudedHexas};
  measure.update("scene");
  CHECK(measure.volume == Approx(4 * 3 * 1.25));
}

TEST_CASE("a curve drawn out is a sheet of quads") {
  ExtrudeEdgesAndGenerateQuads e{.extrudeDirection = {0, 2, 0},
                                 .thicknessIn = 0.5,
                                 .thicknessOut = 1.5,
                                 .numberOfSections = 4,
                                 .curveVertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 1}},
                                 .curveEdges = {{0, 1}, {1, 2}}};
  e.update("scene");
  CHECK(e.extrudedVertices.size() == 15);
  // -thicknessIn d, then steps of 2 / 4 along the unit vector
  CHECK(e.extrudedVertices[0] == Eigen::Vector3d(0, -1, 0));
  CHECK(e.extrudedVertices[12] == Eigen::Vector3d(0, 1, 0));
  CHECK(e.extrudedQuads.size() == 8);
  CHECK(e.extrudedQuads[0] == Quad{0, 1, 4, 3});
  CHECK(e.extrudedEdges.size() == 2 * 5 + 3 * 4);
  e.curveEdges = {{0, 3}};
  CHECK_THAT(error_of([&] { e.update("scene"); }), Contains("edge 0 refers to point 3"));
}

TEST_CASE("along a spiral lengths stay") {
  Spiral s{.restPosition = {}, .curvature = 0.2};
  for (int i = 0; i <= 4000; ++i) s.restPosition.emplace_back(i * 1e-3, 0, 0.5);
  s.update("scene");
  double length = 0;
  for (std::size_t i = 1; i < s.position.size(); ++i) length += (s.position[i] - s.position[i - 1]).norm();
  CHECK(length == Approx(4).epsilon(1e-5));
  for (auto const& x : s.position) CHECK(x[2] == 0.5);
  // r = A t, with the angle t of the place
  const auto& end = s.position.back();
  const double r = std::hypot(end[0], end[1]),
               turns = std::round((r / 0.2 - std::atan2(end[1], end[0])) / 6.2831853);
  CHECK(r == Approx(0.2 * (std::atan2(end[1], end[0]) + 2 * std::numbers::pi * turns)).epsilon(1e-6));
}

TEST_CASE("a box without a lid is closed by a point in its middle") {
  // the unit cube without its upper side, as quads that look outwards
  const Points cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  MeshClosingEngine e{.inputPosition = cube,
                      .inputQuads = {{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  e.update("scene");
  REQUIRE(e.position.size() == 9);
  CHECK(e.position[8] == Eigen::Vector3d(0.5, 0.5, 1));
  CHECK(e.closingTriangles.size() == 4);
  REQUIRE(e.indices.size() == 1);
  CHECK(e.indices[0].size() == 5);
  CHECK(e.indices[0].back() == 8);
  VolumeFromTriangles<Vec3d> measure{.position = e.position, .triangles = e.triangles, .quads = e.quads};
  measure.update("scene");
  CHECK(measure.volume == Approx(1));
  // what is closed stays
  e.inputQuads.push_back({4, 5, 6, 7});
  e.update("scene");
  CHECK(e.position.size() == 8);
  CHECK(e.indices.empty());
}

TEST_CASE("points at random are inside, and as far apart as they shall be") {
  GenerateSphere ball{.radius = 1, .tessellationDegree = 4};
  ball.update("scene");
  RandomPointDistributionInSurface e{.minDistanceBetweenPoints = 0.2,
                                     .numberOfInPoints = 40,
                                     .vertices = ball.surfacePosition,
                                     .triangles = ball.triangles};
  e.update("scene");
  REQUIRE(e.inPoints.size() == 40);
  for (std::size_t i = 0; i < 40; ++i) {
    CHECK(e.inPoints[i].norm() < 1);
    for (std::size_t j = 0; j < i; ++j) CHECK((e.inPoints[i] - e.inPoints[j]).norm() >= 0.2);
  }
  const auto before = e.inPoints;
  e.update("scene");
  CHECK(e.inPoints == before);
  e.randomSeed = 7;
  e.update("scene");
  CHECK(e.inPoints != before);
  // no room for so many
  e.minDistanceBetweenPoints = 1.5;
  e.update("scene");
  CHECK(e.inPoints.size() < 20);
}

TEST_CASE("tetrahedra stuffed into a ball fill it, with its surface where points move to it") {
  GenerateSphere ball{.radius = 1, .tessellationDegree = 6};
  ball.update("scene");
  const double surface = inside(ball.surfacePosition, ball.triangles);
  MeshTetraStuffing e{.size = 0.3,
                      .inputPoints = ball.surfacePosition,
                      .inputTriangles = ball.triangles,
                      .snapPoints = true,
                      .splitTetrahedra = true};
  e.update("scene");
  CHECK(volume(e.outputPoints, e.outputTetrahedra) == Approx(surface).epsilon(0.02));
  for (auto const& x : e.outputPoints) CHECK(x.norm() < 1 + 1e-9);
  // the boundary is closed, and each of its points is on the surface: between the in- and the outer sphere
  std::map<Triangle, Triangle> faces;
  for (auto const& t : e.outputTetrahedra)
    for (std::array<std::size_t, 3> const& f :
         {std::array<std::size_t, 3>{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}) {
      const Triangle face{t[f[0]], t[f[1]], t[f[2]]};
      Triangle sorted = face;
      std::sort(sorted.begin(), sorted.end());
      if (faces.erase(sorted) == 0) faces[sorted] = face;
    }
  std::vector<Triangle> border;
  for (auto const& [sorted, face] : faces) border.push_back(face);
  CHECK(closed(border));
  for (auto const& t : border)
    for (const Index i : t) CHECK(e.outputPoints[std::size_t(i)].norm() > 0.97);
  // uncut, whole cells of the lattice: each twelfth of a cube
  e.snapPoints = e.splitTetrahedra = false;
  e.update("scene");
  CHECK(volume(e.outputPoints, e.outputTetrahedra) == Approx(double(e.outputTetrahedra.size()) * 0.027 / 12));
}

TEST_CASE("mistakes in meshes that are made are told") {
  GenerateGrid flat{.max = {1, 0, 1}};
  CHECK_THAT(error_of([&] { flat.update("scene"); }), Contains("GenerateGrid: min and max are at one y"));
  GenerateGrid fine{.max = {1, 1, 1}, .resolution = {300, 300, 300}};
  CHECK_THAT(error_of([&] { fine.update("scene"); }), Contains("more than 2^24 points"));
  GenerateCylinder thin{.radius = 0};
  CHECK_THAT(error_of([&] { thin.update("scene"); }), Contains("radius is 0 m"));
  MeshTetraStuffing nothing{};
  CHECK_THAT(error_of([&] { nothing.update("scene"); }), Contains("there is no surface"));
  GenerateSphere ball{.radius = 1};
  ball.update("scene");
  for (auto& t : ball.triangles) std::swap(t[0], t[1]);
  MeshTetraStuffing turned{.inputPoints = ball.surfacePosition, .inputTriangles = ball.triangles};
  CHECK_THAT(error_of([&] { turned.update("scene"); }), Contains("look inwards"));
  MeshTetraStuffing tiny{.size = 1e-4, .inputPoints = ball.surfacePosition, .inputTriangles = ball.triangles};
  CHECK_THAT(error_of([&] { tiny.update("scene"); }), Contains("2^24 lattice points"));
  RandomPointDistributionInSurface empty{};
  CHECK_THAT(error_of([&] { empty.update("scene"); }), Contains("there is no surface"));
  Spiral nan{.restPosition = {{std::nan(""), 0, 0}}};
  CHECK_THAT(error_of([&] { nan.update("scene"); }), Contains("rest_position[0]") && Contains("finite"));
}

}  // namespace test_generated_meshes
