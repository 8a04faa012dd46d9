// SPDX-License-Identifier: BSL-1.0
// Parts of meshes that engines choose, and meshes that they merge, smooth, dilate and measure.
#include <sinew/engine/complementary_roi.hpp>
#include <sinew/engine/dilate_engine.hpp>
#include <sinew/engine/generate_grid.hpp>
#include <sinew/engine/generate_sphere.hpp>
#include <sinew/engine/join_points.hpp>
#include <sinew/engine/merge_meshes.hpp>
#include <sinew/engine/merge_points.hpp>
#include <sinew/engine/merge_rois.hpp>
#include <sinew/engine/mesh_barycentric_mapper.hpp>
#include <sinew/engine/mesh_boundary_roi.hpp>
#include <sinew/engine/mesh_roi.hpp>
#include <sinew/engine/mesh_sampler.hpp>
#include <sinew/engine/mesh_splitting.hpp>
#include <sinew/engine/mesh_subset.hpp>
#include <sinew/engine/normals_from_points.hpp>
#include <sinew/engine/proximity_roi.hpp>
#include <sinew/engine/select_label_roi.hpp>
#include <sinew/engine/smooth_mesh.hpp>
#include <sinew/engine/volume_from_triangles.hpp>
#include <sinew/engine/volume_from_volumetric_elements.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <cmath>

namespace test_chosen_meshes {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;
using Numbers = std::vector<int>;

namespace {

static_assert(Engine<MergeMeshes<Vec3d>> && Engine<MergePoints<Vec3d>> && Engine<MeshROI<Vec3d>> &&
              Engine<ProximityROI<Vec3d>> && Engine<MeshSplittingEngine> && Engine<MeshSampler>);

GenerateGrid sheet(int nx, int ny) {
  GenerateGrid grid{.max = {double(nx), double(ny), 0}, .resolution = {nx, ny, 0}};
  grid.update("scene");
  return grid;
}
GenerateGrid block(int n) {
  GenerateGrid grid{.max = {double(n), double(n), double(n)}, .resolution = {n, n, n}};
  grid.update("scene");
  return grid;
}
Numbers sorted(Numbers list) {
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace

TEST_CASE("merged meshes have the points and the volume of both") {
  const GenerateGrid a = block(2), b = block(3);
  MergeMeshes<Vec3d> m{.positions = {a.position, b.position},
                       .tetrahedraOf = {a.tetrahedra, b.tetrahedra},
                       .hexahedraOf = {{}, b.hexahedra}};
  m.update("scene");
  CHECK(m.npoints == 27 + 64);
  CHECK(m.hexahedra.size() == 27);
  CHECK(m.hexahedra[0][0] == 27 + b.hexahedra[0][0]);
  VolumeFromVolumetricElements<Vec3d> measure{.position = m.position, .tetrahedra = m.tetrahedra};
  measure.update("scene");
  CHECK(measure.volume == Approx(8 + 27));
  m.nbMeshes = 1;
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("2 lists of points, but nbMeshes is 1"));
  m.nbMeshes = 2, m.positions[1].pop_back();
  CHECK_THAT(error_of([&] { m.update("scene"); }),
             Contains("MergeMeshes<Vec3d>: mesh 2") && Contains("point 63"));
  CHECK(m.npoints == 27 + 64);
}

TEST_CASE("points are merged one after the other, or into places of the first") {
  MergePoints<Vec3d> m{.position1 = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .position2 = {{0, 5, 0}, {1, 5, 0}}};
  m.update("scene");
  CHECK(m.points.size() == 5);
  CHECK(m.indices2 == Numbers{3, 4});
  m.mappingX2 = {2, 0};
  m.update("scene");
  CHECK(m.points == Points{{1, 5, 0}, {1, 0, 0}, {0, 5, 0}});
  CHECK(m.indices1 == Numbers{1});
  CHECK(m.indices2 == Numbers{0, 2});
  m.mappingX2 = {3};
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("mappingX2 has 3"));
}

TEST_CASE("points near each other are joined in their mean") {
  JoinPoints j{.points = {{0, 0, 0}, {0.1, 0, 0}, {5, 0, 0}, {0.05, 0, 0}, {5, 0.2, 0}}, .distance = 0.15};
  j.update("scene");
  REQUIRE(j.mergedPoints.size() == 3);
  CHECK((j.mergedPoints[0] - Eigen::Vector3d(0.05, 0, 0)).norm() < 1e-15);
  CHECK(j.mergedPoints[2] == Eigen::Vector3d(5, 0.2, 0));
}

TEST_CASE("the border of a sheet is its edge, and of a part of it that of the part") {
  const GenerateGrid g = sheet(4, 3);
  MeshBoundaryROI r{.quads = g.quads};
  r.update("scene");
  CHECK(r.indices.size() == 2 * (4 + 3));
  for (const int i : r.indices) {
    auto const& x = g.position[std::size_t(i)];
    CHECK((x[0] == 0 || x[0] == 4 || x[1] == 0 || x[1] == 3));
  }
  MeshBoundaryROI part{.triangles = g.triangles, .inputROI = {0, 1, 5, 6}};
  part.update("scene");
  CHECK(part.indices == Numbers{0, 1, 5, 6});
}

TEST_CASE("what is inside a ball is chosen by rays through its surface") {
  GenerateSphere ball{.radius = 1.6, .origin = {2, 2, 2}, .tessellationDegree = 8};
  ball.update("scene");
  const GenerateGrid g = block(4);
  MeshROI<Vec3d> r{.ROIposition = ball.surfacePosition,
                   .ROItriangles = ball.triangles,
                   .position = g.position,
                   .tetrahedra = g.tetrahedra,
                   .strict = true};
  r.update("scene");
  std::size_t expected = 0;
  for (std::size_t i = 0; i < g.position.size(); ++i)
    expected += (g.position[i] - Eigen::Vector3d(2, 2, 2)).norm() < 1.6;
  CHECK(r.indices.size() == expected);
  CHECK(expected == 19);  // 1 + 6 at 1 + 12 at sqrt 2
  for (auto const& t : r.tetrahedraInROI)
    for (const Index i : t) CHECK((g.position[std::size_t(i)] - Eigen::Vector3d(2, 2, 2)).norm() < 1.6);
  CHECK(r.indicesOut.size() == 125 - 19);
  r.computeMeshROI = false;
  r.update("scene");
  CHECK(r.nbIndices == 125);
  r.computeMeshROI = true, r.ROItriangles.clear();
  CHECK_THAT(error_of([&] { r.update("scene"); }), Contains("ROItriangles is empty"));
}

TEST_CASE("a mesh is split in parts, and index pairs say where each point went") {
  const GenerateGrid g = sheet(2, 1);
  MeshSplittingEngine s{
      .position = g.position, .quads = g.quads, .nbInputs = 2, .indices = {{}, {0, 2}}, .quadIndices = {{0}}};
  s.update("scene");
  REQUIRE(s.positions.size() == 3);
  // the first quad has 0 1 4 3; 2 is of the second part, 5 of the rest
  CHECK(s.positions[0].size() == 4);
  CHECK(s.positions[1] == Points{{2, 0, 0}});
  CHECK(s.positions[2] == Points{{2, 1, 0}});
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(s.positions[std::size_t(s.indexPairs[2 * i])][std::size_t(s.indexPairs[2 * i + 1])] ==
          g.position[i]);
  s.quadIndices = {{2}};
  CHECK_THAT(error_of([&] { s.update("scene"); }), Contains("quadIndices has 2") && Contains("2 quads"));
  s.quadIndices = {{0}, {}, {1}};
  CHECK_THAT(error_of([&] { s.update("scene"); }), Contains("3 lists quadIndices, but nbInputs is 2"));
}

TEST_CASE("samples of a line are at the middles of its parts") {
  MeshSampler s{.number = 3};
  for (int i = 0; i < 30; ++i) s.position.emplace_back(i, 0, 0);
  s.update("scene");
  CHECK(sorted(s.outputIndices).size() == 3);
  Numbers found = sorted(s.outputIndices);
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(found[k] - (4.5 + 10 * double(k))) <= 2);
  // along the edges of a hairpin its two ends are far from each other
  MeshSampler bent{.number = 2, .maxIter = 0};
  for (int i = 0; i < 10; ++i) bent.position.emplace_back(i, 0, 0);
  for (int i = 9; i >= 0; --i) bent.position.emplace_back(i, 0.1, 0);
  bent.update("scene");
  CHECK(std::abs(bent.outputIndices[1] - 10) <= 1);
  for (int i = 0; i < 19; ++i) bent.edges.push_back({i, i + 1});
  bent.update("scene");
  CHECK(bent.outputIndices == Numbers{0, 19});
  bent.edges = {{0, 20}};
  CHECK_THAT(error_of([&] { bent.update("scene"); }), Contains("edge 0 refers to point 20"));
}

TEST_CASE("a part of a mesh counts its own points") {
  const GenerateGrid g = sheet(2, 2);
  MeshSubsetEngine s{.inputPosition = g.position,
                     .inputTriangles = g.triangles,
                     .inputQuads = g.quads,
                     .indices = {8, 7, 4, 5}};
  s.update("scene");
  CHECK(s.quads == std::vector<Quad>{{2, 3, 0, 1}});
  CHECK(s.triangles.size() == 2);
  CHECK(s.position[0] == Eigen::Vector3d(2, 2, 0));
  s.indices = {9};
  CHECK_THAT(error_of([&] { s.update("scene"); }), Contains("indices has 9, but the mesh has 9 points"));
}

TEST_CASE("the nearest points to centres are chosen, no more than N") {
  ProximityROI<Vec3d> r{.centers = {{0, 0, 0}, {9, 0, 0}}, .radii = {2.5}, .N = 4};
  for (int i = 0; i < 10; ++i) r.position.emplace_back(i, 0, 0);
  r.update("scene");
  CHECK(sorted(r.indices) == Numbers{0, 1, 8, 9});
  CHECK(r.indices.size() + r.indicesOut.size() == 10);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(r.distance[k] == std::min(r.pointsInROI[k][0], 9 - r.pointsInROI[k][0]));
  r.N = 0;
  r.update("scene");
  CHECK(r.indices.empty());
  r.N = 4;
  r.radii.clear();
  r.update("scene");
  CHECK(r.indices.empty());
}

TEST_CASE("sets: their complement, their list, and what has a label") {
  ComplementaryROI c{.position = Points(5, {0, 0, 0}), .nbSet = 2, .setIndices = {{0, 3}, {3}}};
  c.update("scene");
  CHECK(c.indices == Numbers{1, 2, 4});
  c.setIndices.push_back({1});
  CHECK_THAT(error_of([&] { c.update("scene"); }), Contains("3 sets, but nbSet is 2"));
  c.setIndices = {{5}};
  CHECK_THAT(error_of([&] { c.update("scene"); }), Contains("setIndices has 5"));
  MergeROIs m{.nbROIs = 3, .indices = {{1, 2}, {}}};
  m.update("scene");
  CHECK(m.roiIndices == std::vector<Numbers>{{1, 2}, {}, {}});
  SelectLabelROI s{.labels = {{1, 2}, {}, {3}, {2}}, .selectLabels = {2, 7}};
  s.update("scene");
  CHECK(s.indices == Numbers{0, 3});
}

TEST_CASE("points of a tetrahedron and of a triangle have their coordinates") {
  MeshBarycentricMapperEngine m{.inputPositions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2}},
                                .mappedPointPositions = {{0.5, 0.25, 1}, {1.4, 1.4, 1.4}, {9, 9, 9}},
                                .tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}},
                                .computeLinearInterpolation = true};
  m.update("scene");
  CHECK(m.tableElements == Numbers{0, 1, 1});
  CHECK((m.barycentricPositions[0] - Eigen::Vector3d(0.25, 0.125, 0.5)).norm() < 1e-15);
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k)
      x += m.linearInterpolationValues[i][k] *
           m.inputPositions[std::size_t(m.linearInterpolationIndices[i][k])];
    CHECK((x - m.mappedPointPositions[i]).norm() < 1e-14);
  }
  m.tetrahedra.clear(), m.triangles = {{0, 1, 2}};
  m.mappedPointPositions = {{0.5, 1, 0.001}};
  m.update("scene");
  CHECK((m.barycentricPositions[0] - Eigen::Vector3d(0.25, 0.5, 0)).norm() < 1e-15);
  m.triangles = {{0, 1, 1}};
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("triangle 0 is flat"));
}

TEST_CASE("normals of a cube look along its diagonals, by angle as by corner") {
  const GenerateGrid g = block(1);
  NormalsFromPoints n{
      .position = g.position,
      .quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const bool angles : {false, true}) {
    n.useAngles = angles;
    n.update("scene");
    for (std::size_t i = 0; i < 8; ++i)
      CHECK((n.normals[i] - (g.position[i] - Eigen::Vector3d(0.5, 0.5, 0.5)).normalized()).norm() < 1e-12);
  }
  // cut into triangles, angles alone keep the diagonal
  NormalsFromPoints cut{.position = n.position, .useAngles = true};
  for (auto const& [a, b, c, d] : n.quads) cut.triangles.insert(cut.triangles.end(), {{a, b, c}, {a, c, d}});
  cut.update("scene");
  CHECK((cut.normals[0] - n.normals[0]).norm() < 1e-12);
  cut.invertNormals = true;
  cut.update("scene");
  CHECK((cut.normals[0] + n.normals[0]).norm() < 1e-12);
}

TEST_CASE("smoothing leaves the middle of a sheet flat, and draws a peak down to the mean around it") {
  GenerateGrid g = sheet(4, 4);
  g.position[12][2] = 1;
  SmoothMeshEngine s{.inputPosition = g.position, .inputIndices = {12}, .quads = g.quads};
  s.update("scene");
  CHECK(s.outputPosition[12] == Eigen::Vector3d(2, 2, 0));
  s.inputIndices.clear();
  s.update("scene");
  CHECK(s.outputPosition[12][2] == 0);
  CHECK(s.outputPosition[11][2] == 0.25);  // one of its four neighbours was up
  s.quads.clear();
  CHECK_THAT(error_of([&] { s.update("scene"); }), Contains("the mesh has no edge"));
}

TEST_CASE("a ball is dilated to a larger one, and what is thin is thickened") {
  GenerateSphere ball{.radius = 1, .tessellationDegree = 6};
  ball.update("scene");
  DilateEngine d{.inputPosition = ball.surfacePosition, .triangles = ball.triangles, .distance = 0.25};
  d.update("scene");
  for (auto const& x : d.outputPosition) CHECK(x.norm() == Approx(1.25).epsilon(2e-3));
  // a plate 0.1 thick, that shall be 0.3 thick
  const GenerateGrid g = block(1);
  DilateEngine plate{.inputPosition = g.position, .quads = {{0, 2, 3, 1}, {4, 5, 7, 6}}, .minThickness = 0.3};
  for (auto& x : plate.inputPosition) x[2] *= 0.1;
  plate.update("scene");
  for (std::size_t i = 0; i < 8; ++i) CHECK(plate.outputPosition[i][2] == Approx(i < 4 ? -0.1 : 0.2));
}

}  // namespace test_chosen_meshes
