// SPDX-License-Identifier: BSL-1.0
// Parts of meshes: SubsetTopology and PointsFromIndices.
#include <sinew/engine/points_from_indices.hpp>
#include <sinew/engine/subset_topology.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <set>

namespace test_subsets {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

static_assert(Engine<SubsetTopology<Vec3d>> && Engine<SubsetTopology<Rigid3d>> &&
              Engine<PointsFromIndices<Vec3d>>);

// 4 x 2 x 2 cells, one apart
Mesh grid() { return regular_grid(5, 3, 3, {0, 0, 0}, {4, 2, 2}); }

SubsetTopology<Vec3d> lower_half(bool local) {
  const Mesh mesh = grid();
  return {.box = {{-1, -1, -1, 2, 3, 3}},
          .position = mesh.positions,
          .tetrahedra = hexahedra_to_tetrahedra(mesh.hexahedra),
          .hexahedra = mesh.hexahedra,
          .localIndices = local};
}

double volume(std::vector<Eigen::Vector3d> const& x, std::vector<Tetrahedron> const& all) {
  double sum = 0;
  for (auto const& t : all) {
    auto at = [&](std::size_t k) { return x[std::size_t(t[k])]; };
    sum += (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0))) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("a mesh is divided in elements with all their points in a box, and the others") {
  auto s = lower_half(false);
  s.update("scene");
  CHECK(s.indices.size() == 27);
  CHECK(s.pointsInROI.size() == 27);
  CHECK(s.pointsOutROI.size() == 18);
  CHECK(s.hexahedraInROI.size() == 8);
  CHECK(s.hexahedraOutROI.size() == 8);
  CHECK(s.tetrahedraInROI.size() + s.tetrahedraOutROI.size() == s.tetrahedra.size());
  CHECK(volume(s.position, s.tetrahedraInROI) == Approx(8));
  for (std::size_t k = 0; k < s.hexahedronIndices.size(); ++k)
    CHECK(s.hexahedraInROI[k] == s.hexahedra[std::size_t(s.hexahedronIndices[k])]);
  // updating again starts afresh
  const auto before = s.hexahedraOutROI;
  s.update("scene");
  CHECK(s.hexahedraOutROI == before);
  CHECK(s.pointsInROI.size() == 27);
}

TEST_CASE("with local indices both parts are meshes, which share the first points") {
  auto s = lower_half(true);
  s.update("scene");
  REQUIRE(s.nbrborder == 9);
  CHECK(s.pointsInROI.size() == 27);
  CHECK(s.pointsOutROI.size() == 18 + 9);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(s.pointsInROI[i] == s.pointsOutROI[i]);
    CHECK(s.pointsInROI[i][0] == 2);
  }
  for (std::size_t i = 0; i < s.indices.size(); ++i)
    CHECK(s.pointsInROI[i] == s.position[std::size_t(s.indices[i])]);
  CHECK(volume(s.pointsInROI, s.tetrahedraInROI) == Approx(8));
  CHECK(volume(s.pointsOutROI, s.tetrahedraOutROI) == Approx(8));
}

TEST_CASE("an element between two boxes is in none, and spheres stand in the place of boxes") {
  auto s = lower_half(false);
  s.box = {{-1, -1, -1, 1, 3, 3}, {2, -1, -1, 5, 3, 3}};
  s.update("scene");
  CHECK(s.pointsInROI.size() == 45);
  CHECK(s.hexahedraInROI.size() == 12);
  s.centers = {{0, 0, 0}};
  s.radii = {std::sqrt(3.)};
  s.update("scene");
  CHECK(s.hexahedronIndices == std::vector<int>{0});
}

TEST_CASE("tetrahedra may be named instead") {
  auto s = lower_half(true);
  s.tetrahedraInput = {3, 0, 3};
  s.update("scene");
  CHECK(s.tetrahedronIndices == std::vector<int>{0, 3});
  std::set<Index> points(s.tetrahedra[0].begin(), s.tetrahedra[0].end());
  points.insert(s.tetrahedra[3].begin(), s.tetrahedra[3].end());
  CHECK(s.indices.size() == points.size());
  CHECK(volume(s.pointsInROI, s.tetrahedraInROI) + volume(s.pointsOutROI, s.tetrahedraOutROI) == Approx(16));
  // two tetrahedra of a hexahedron do not have all of its corners, whatever is in the boxes
  CHECK(s.hexahedraInROI.empty());
  REQUIRE(s.hexahedraOutROI.size() == s.hexahedra.size());
  for (std::size_t e = 0; e < s.hexahedra.size(); ++e)
    for (std::size_t k = 0; k < 8; ++k) {
      const auto there = std::size_t(s.hexahedra[e][k]), out = std::size_t(s.hexahedraOutROI[e][k]);
      const bool inside =
          points.contains(Index(there)) &&
          std::find(s.pointsOutROI.begin(), s.pointsOutROI.end(), s.position[there]) == s.pointsOutROI.end();
      if (!inside) CHECK(s.pointsOutROI[out] == s.position[there]);
      CHECK_FALSE(inside);
    }
}

TEST_CASE("mistakes in the parts of meshes are told") {
  auto said = [](auto const& change) {
    auto s = lower_half(false);
    change(s);
    return error_of([&] { s.update("scene"); });
  };
  CHECK_THAT(said([](auto& s) { s.position.clear(); }),
             Contains("scene: SubsetTopology<Vec3d>: rest_position is empty"));
  CHECK_THAT(said([](auto& s) { s.centers = {{0, 0, 0}}; }), Contains("1 centers and 0 radii"));
  CHECK_THAT(said([](auto& s) { s.hexahedra[2][5] = 45; }), Contains("hexahedron 2"));
  CHECK_THAT(said([](auto& s) { s.tetrahedraInput = {96}; }),
             Contains("tetrahedraInput has 96") && Contains("96 tetrahedra"));
}

TEST_CASE("points are chosen by index, each place once") {
  PointsFromIndices<Vec3d> p{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}},
                             .indices = {3, 0, 1, 0}};
  p.update("scene");
  CHECK(p.chosen == Vec3d::VecCoord{{1, 0, 0}, {0, 0, 0}});
  p.indices = {4};
  CHECK_THAT(error_of([&] { p.update("scene"); }),
             Contains("scene: PointsFromIndices<Vec3d>: indices has 4") && Contains("4 points"));
  CHECK(p.chosen.size() == 2);
}

}  // namespace test_subsets
