// SPDX-License-Identifier: BSL-1.0
// Grids over surfaces whose cells hold several parts of a body, or several bodies.
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/topology/sparse_grid_multiple_topology.hpp>
#include <sinew/topology/sparse_grid_ramification_topology.hpp>
#include <sinew/topology/sparse_grid_topology.hpp>

#include <cstdio>

#include "io/files.hpp"
#include "mesh_checks.hpp"

namespace test_sparse_grid_ramification {

using namespace sinew;
using Ramified = SparseGridRamificationTopology;

namespace {

void add_block(Mesh& mesh, Eigen::Vector3d const& low, Eigen::Vector3d const& high) {
  const auto n = Index(mesh.positions.size());
  for (auto const& c : hexahedronCorners)
    mesh.positions.push_back(low + (high - low).cwiseProduct(Eigen::Vector3d(c[0], c[1], c[2])));
  for (auto const& f : hexahedronFaces) {
    mesh.triangles.push_back({n + Index(f[0]), n + Index(f[1]), n + Index(f[2])});
    mesh.triangles.push_back({n + Index(f[0]), n + Index(f[2]), n + Index(f[3])});
  }
}
// a fork of two tines along x, of 0.3 m, 0.4 m apart, on a base
Mesh fork() {
  Mesh mesh;
  add_block(mesh, {0, 0, 0}, {1, 1, 0.5});
  add_block(mesh, {0.9, 0, 0}, {4, 0.3, 0.5});
  add_block(mesh, {0.9, 0.7, 0}, {4, 1, 0.5});
  return mesh;
}
template <class T>
T made(T grid) {
  grid.generate("/root");
  return grid;
}
// how many lots of hexahedra share no point
template <class T>
int lots(T const& grid) {
  std::vector<int> lot(grid.points.size());
  for (std::size_t i = 0; i < lot.size(); ++i) lot[i] = int(i);
  for (bool changed = true; changed;) {
    changed = false;
    for (auto const& h : grid.hexahedra) {
      int least = lot[std::size_t(h[0])];
      for (const Index i : h) least = std::min(least, lot[std::size_t(i)]);
      for (const Index i : h)
        if (lot[std::size_t(i)] != least) lot[std::size_t(i)] = least, changed = true;
    }
  }
  std::sort(lot.begin(), lot.end());
  return int(std::unique(lot.begin(), lot.end()) - lot.begin());
}
bool contains(std::string const& all, std::string_view part) { return all.find(part) != all.npos; }
std::string obj(Mesh const& mesh) {
  std::string text_;
  for (auto const& p : mesh.positions) {
    char line[100];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    text_ += line;
  }
  for (auto const& t : mesh.triangles) text_ += text("f ", t[0] + 1, ' ', t[1] + 1, ' ', t[2] + 1, '\n');
  return text_;
}

}  // namespace

TEST_CASE("the tines of a fork have hexahedra of their own in the cells that they share") {
  const Mesh mesh = fork();
  const Ramified sample{.n = {5, 2, 2},
                        .position = mesh.positions,
                        .triangles = mesh.triangles,
                        .nbVirtualFinerLevels = 3,
                        .finestConnectivity = false};
  const auto grid = made(sample);
  // the base is in two cells, the second by its end; in each of the two others both tines have a part
  CHECK(grid.hexahedra.size() == 2 + 2 * 2);
  CHECK(grid.points.size() == 3 * 4 + 2 * 2 * 4);
  CHECK(lots(grid) == 1);
  const auto plain =
      made(SparseGridTopology{.n = {5, 2, 2}, .position = mesh.positions, .triangles = mesh.triangles});
  CHECK(plain.hexahedra.size() == 4);
  // without the base they are two bodies
  Mesh apart;
  add_block(apart, {0, 0, 0}, {4, 0.3, 0.5});
  add_block(apart, {0, 0.7, 0}, {4, 1, 0.5});
  auto two = sample;
  two.position = apart.positions, two.triangles = apart.triangles;
  two = made(two);
  CHECK(two.hexahedra.size() == 8);
  CHECK(two.points.size() == 2 * 5 * 4);
  CHECK(lots(two) == 2);
}

TEST_CASE("a point goes with the part of the cell in which it lies") {
  Mesh apart;
  add_block(apart, {0, 0, 0}, {4, 0.3, 0.5});
  add_block(apart, {0, 0.7, 0}, {4, 1, 0.5});
  const auto grid = made(Ramified{.n = {5, 2, 2},
                                  .position = apart.positions,
                                  .triangles = apart.triangles,
                                  .nbVirtualFinerLevels = 3,
                                  .finestConnectivity = false});
  REQUIRE(grid.parents.size() == grid.finer.hexahedra.size());
  BarycentricMapping<Vec3d, Vec3d> mapping;
  Vec3d::VecCoord child{{2.2, 0.1, 0.2}, {2.2, 0.9, 0.2}};
  const Vec3d::VecCoord at = child;
  mapping.init({"grid", grid.points, grid.view()}, {"child", at, {}}, child);
  mapping.apply(child, grid.points);
  for (std::size_t i = 0; i < 2; ++i) CHECK(child[i].isApprox(at[i]));
  // when one body moves, the other stays
  auto moved = grid.points;
  std::vector<bool> first(moved.size(), false);
  for (auto const& h : grid.hexahedra) {
    Eigen::Vector3d middle(0, 0, 0);
    for (std::size_t c = 0; c < grid.parents.size(); ++c)
      if (&grid.hexahedra[std::size_t(grid.parents[c])] == &h)
        middle = grid.finer.positions[std::size_t(grid.finer.hexahedra[c][0])];
    for (const Index i : h) first[std::size_t(i)] = middle[1] < 0.5;
  }
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (first[i]) moved[i] += Eigen::Vector3d(0, 0, 7);
  mapping.apply(child, moved);
  CHECK(child[0].isApprox(at[0] + Eigen::Vector3d(0, 0, 7)));
  CHECK(child[1].isApprox(at[1]));
}

TEST_CASE("cells are as filled as their finer cells are") {
  Mesh mesh;
  add_block(mesh, {0, 0, 0}, {1, 1, 1});
  const auto grid = made(SparseGridTopology{
      .n = {2, 2, 2}, .position = mesh.positions, .triangles = mesh.triangles, .nbVirtualFinerLevels = 2});
  // of 4 x 4 x 4 cells the 8 in the middle are full and the others half
  REQUIRE(grid.fill.size() == 1);
  CHECK(grid.fill[0] == Approx((8 + 56 * 0.5) / 64));
  CHECK(grid.massFill == grid.fill);
  CHECK(grid.view().finer.hexahedra.empty());
  // a cell is there where one of its eight is
  Mesh small;
  add_block(small, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2});
  auto coarse = grid;
  coarse.position = small.positions;
  coarse.n = {9, 9, 9}, coarse.nbVirtualFinerLevels = 1;
  coarse.min = Eigen::Vector3d(-4, -4, -4), coarse.max = Eigen::Vector3d(4, 4, 4);
  coarse = made(coarse);
  CHECK(coarse.hexahedra.size() == 1);
  CHECK(coarse.fill[0] == 0.5 / 8);
}

TEST_CASE("without finer levels cells are apart where no surface crosses their face") {
  // two plates whose cells touch, but which do not
  Mesh mesh;
  add_block(mesh, {0.1, 0.1, 0.1}, {0.9, 1.9, 0.9});
  add_block(mesh, {1.1, 0.1, 0.1}, {1.9, 1.9, 0.9});
  Ramified sample{.n = {3, 3, 2},
                  .position = mesh.positions,
                  .triangles = mesh.triangles,
                  .min = Eigen::Vector3d(0, 0, 0),
                  .max = Eigen::Vector3d(2, 2, 1)};
  auto grid = made(sample);
  CHECK(grid.hexahedra.size() == 4);
  CHECK(grid.points.size() == 2 * 12);
  CHECK(lots(grid) == 2);
  sample.finestConnectivity = false;  // a SparseGridTopology
  grid = made(sample);
  CHECK(grid.points.size() == 18);
  CHECK(grid.points == made(SparseGridTopology{.n = sample.n,
                                               .position = mesh.positions,
                                               .triangles = mesh.triangles,
                                               .min = sample.min,
                                               .max = sample.max})
                           .points);
}

TEST_CASE("without connectivity of the finest cells points will do, which cells hold and shut in") {
  std::vector<Eigen::Vector3d> cloud;  // a hollow cube, and a point beside it
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        if (i % 7 == 0 || j % 7 == 0 || k % 7 == 0) cloud.emplace_back(i + 0.5, j + 0.5, k + 0.5);
  cloud.emplace_back(10.5, 0.5, 0.5);
  const Ramified sample{.n = {4, 3, 3},
                        .position = cloud,
                        .min = Eigen::Vector3d(0, 0, 0),
                        .max = Eigen::Vector3d(12, 8, 8),
                        .nbVirtualFinerLevels = 2,
                        .finestConnectivity = false};
  const auto grid = made(sample);
  CHECK(grid.levels.back().hexahedra.size() == 8 * 8 * 8 + 1);
  CHECK(grid.hexahedra.size() == 2 * 2 * 2 + 1);
  CHECK(lots(grid) == 2);
  CHECK(grid.points.size() == 27 + 8);
}

TEST_CASE("surfaces in one another have materials of their own") {
  Mesh outer, inner;
  add_block(outer, {0.1, 0.1, 0.1}, {3.9, 2.9, 2.9});
  add_block(inner, {1.1, 1.1, 1.1}, {1.9, 1.9, 1.9});
  const files::TempFolder folder;
  SparseGridMultipleTopology sample{
      .n = {5, 4, 4},
      .min = Eigen::Vector3d(0, 0, 0),
      .max = Eigen::Vector3d(4, 3, 3),
      .finestConnectivity = false,
      .fileTopologies = {{folder.write("a.obj", obj(outer))}, {folder.write("b.obj", obj(inner))}},
      .stiffnessCoefs = {10, 100},
      .massCoefs = {2}};
  auto grid = made(sample);
  REQUIRE(grid.fill.size() == 36);
  auto at = [&](Eigen::Vector3d const& low) {
    for (std::size_t h = 0; h < 36; ++h)
      if (grid.points[std::size_t(grid.hexahedra[h][0])].isApprox(low, 1e-9)) return h;
    FAIL("there is no such cell");
    return std::size_t(0);
  };
  CHECK(grid.fill[at({0, 0, 0})] == 5);        // touched by the outer one: (0 + 10)/2
  CHECK(grid.fill[at({2, 1, 1})] == 10);       // inside of it
  CHECK(grid.fill[at({1, 1, 1})] == 55);       // and touched by the inner one: (10 + 100)/2
  CHECK(grid.massFill[at({1, 1, 1})] == 1.5);  // (2 + 1)/2
  sample.erasePreviousCoef = true;
  grid = made(sample);
  CHECK(grid.fill[at({1, 1, 1})] == 100);
  sample.fillWeighted = false;
  grid = made(sample);
  CHECK(grid.fill[at({0, 0, 0})] == 10);
  CHECK(grid.fill[at({1, 1, 1})] == 100);
  // finer levels of what they are made of
  sample.nbVirtualFinerLevels = 1;
  grid = made(sample);
  CHECK(grid.fill[at({1, 1, 1})] == 100);
  CHECK(grid.parents.size() == 8 * 36);
}

TEST_CASE("grids of several parts say what is wrong") {
  Mesh mesh;
  add_block(mesh, {0, 0, 0}, {1, 1, 1});
  const Ramified good{.n = {3, 3, 3}, .position = mesh.positions, .triangles = mesh.triangles};
  auto refusal = [](auto const& grid) {
    return error_of([&] {
      check_fields(grid, "/root");
      made(grid);
    });
  };
  auto change = [&](auto edit) {
    Ramified grid = good;
    edit(grid);
    return refusal(grid);
  };
  CHECK(refusal(good).empty());
  CHECK(contains(change([](auto& g) { g.triangles.clear(); }),
                 "/root: SparseGridRamificationTopology: there is no surface"));
  CHECK(contains(change([](auto& g) { g.nbVirtualFinerLevels = 24; }),
                 "more than 2^24 points; give fewer levels"));
  CHECK(contains(change([](auto& g) { g.nbVirtualFinerLevels = 9; }), "2^24"));
  CHECK(contains(change([](auto& g) { g.nbVirtualFinerLevels = -1; }), "nbVirtualFinerLevels is -1"));
  CHECK(contains(change([](auto& g) { g.triangles.resize(5), g.n = {8, 8, 8}; }), "is not closed"));
  CHECK(contains(refusal(SparseGridMultipleTopology{}), "fileTopologies names no file"));
  CHECK(contains(refusal(SparseGridMultipleTopology{.fileTopologies = {{"missing.obj"}}}), "missing.obj"));
}

}  // namespace test_sparse_grid_ramification
