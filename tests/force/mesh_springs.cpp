// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/mesh_spring.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <array>
#include <cmath>
#include <map>

namespace test_mesh_springs {

using namespace sinew;
using one::force;
using one::ready;

namespace {

using Mesh3 = MeshSpringForceField<Vec3d>;
using Grid3 = RegularGridSpringForceField<Vec3d>;

std::size_t count(auto const& component) {
  std::size_t springs = 0;
  for (auto const& pack : component.driver.packs) springs += std::size_t(pack.active);
  return springs;
}

/// Stiffness [N/m] of each spring by its two ends.
std::map<std::array<int, 2>, double> stiffnesses(auto const& component) {
  std::map<std::array<int, 2>, double> found;
  for (auto const& pack : component.driver.packs)
    for (int l = 0; l < pack.active; ++l)
      found[{std::min(pack.index[0][l], pack.index[1][l]), std::max(pack.index[0][l], pack.index[1][l])}] =
          lane(pack.rest.stiffness, l);
  return found;
}

const Vec3d::VecCoord corners{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const std::vector<Tetrahedron> tetrahedron{{0, 1, 2, 3}};
const std::vector<Edge> edges{{0, 1}, {2, 0}};
const std::vector<Triangle> triangle{{0, 1, 2}};

const std::vector<Hexahedron> cube{{0, 1, 2, 3, 4, 5, 6, 7}};
const Vec3d::VecCoord cubeCorners{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

}  // namespace

TEST_CASE("a stiffness is a force per relative extension, shared by all springs of a line") {
  auto springs = ready(Mesh3{.stiffness = 12, .damping = 6}, corners, {.edges = edges});
  CHECK(count(springs) == 2);
  // 0-1 has length 2: pulled to 3, an extension of 1/2, it pulls with 12/2 N; 0-2 is at rest
  Vec3d::VecCoord x = corners;
  x[1] = {3, 0, 0};
  const auto f = force(springs, x);
  CHECK((f[0] - Eigen::Vector3d(6, 0, 0)).norm() < 1e-15);
  CHECK((f[1] + Eigen::Vector3d(6, 0, 0)).norm() < 1e-15);
  CHECK(f[2].norm() == 0);
  CHECK(potential_energy(springs, x) == Approx(0.5 * 6 * 1));
  // extending at 1 m/s, a rate of 1/2 per second
  const auto damped = force(springs, corners, {{0, 0, 0}, {1, 0, 0}});
  CHECK((damped[0] - Eigen::Vector3d(3, 0, 0)).norm() < 1e-15);
}

TEST_CASE("two points get one spring, of the first kind that joins them") {
  Mesh3 springs{.linesStiffness = 1, .trianglesStiffness = 2, .tetrahedraStiffness = 3};
  springs = ready(springs, corners, {.edges = edges, .triangles = triangle, .tetrahedra = tetrahedron});
  const auto k = stiffnesses(springs);
  REQUIRE(k.size() == 6);
  CHECK(k.at({0, 1}) == Approx(1 / 2.0));
  CHECK(k.at({0, 2}) == Approx(1 / 3.0));
  CHECK(k.at({1, 2}) == Approx(2 / std::sqrt(13)));
  CHECK(k.at({0, 3}) == Approx(3 / 4.0));
  CHECK(k.at({1, 3}) == Approx(3 / std::sqrt(20)));
  CHECK(k.at({2, 3}) == Approx(3 / 5.0));
  CHECK(count(springs) == 6);
}

TEST_CASE("edges, triangles and quads that are not listed come from higher elements") {
  CHECK(count(ready(Mesh3{.linesStiffness = 1}, corners, {.tetrahedra = tetrahedron})) == 6);
  CHECK(count(ready(Mesh3{.trianglesStiffness = 1}, corners, {.tetrahedra = tetrahedron})) == 6);
  CHECK(count(ready(Mesh3{.linesStiffness = 1}, corners, {.triangles = triangle})) == 3);
  CHECK(count(ready(Mesh3{.linesStiffness = 1}, cubeCorners, {.hexahedra = cube})) == 12);
  CHECK(count(ready(Mesh3{.quadsStiffness = 1}, cubeCorners, {.hexahedra = cube})) == 12 + 12);
  CHECK(count(ready(Mesh3{.cubesStiffness = 1}, cubeCorners, {.hexahedra = cube})) == 28);
  CHECK(count(ready(Mesh3{.stiffness = 1}, cubeCorners, {.hexahedra = cube})) == 28);
  // the kinds of a cube by their lengths
  Mesh3 kinds{.linesStiffness = 1, .quadsStiffness = 2, .cubesStiffness = 3};
  for (auto const& [ends, k] : stiffnesses(ready(kinds, cubeCorners, {.hexahedra = cube}))) {
    const double length = (cubeCorners[std::size_t(ends[0])] - cubeCorners[std::size_t(ends[1])]).norm();
    CHECK(k * length == Approx(std::round(length * length)));
  }
}

TEST_CASE("strings pull and never push") {
  auto strings =
      ready(Mesh3{.stiffness = 12, .damping = 1, .noCompression = true}, corners, {.edges = edges});
  Vec3d::VecCoord x = corners;
  x[1] = {1, 0, 0};
  for (auto const& f : force(strings, x, {{0, 0, 0}, {1, 0, 0}})) CHECK(f.norm() == 0);
  for (auto const& f : one::product(strings, {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}}, 1, 1))
    CHECK(f.norm() == 0);
  CHECK(potential_energy(strings, x) == 0);
  x[1] = {3, 0, 0};
  CHECK((force(strings, x)[0] - Eigen::Vector3d(6, 0, 0)).norm() < 1e-15);
  CHECK(potential_energy(strings, x) == Approx(3));
}

TEST_CASE("a regular grid has springs along lines and diagonals") {
  const int nx = 3, ny = 4, nz = 2;
  const Mesh mesh = regular_grid(nx, ny, nz, {0, 0, 0}, {2, 3, 1});  // unit cells
  const TopologyView grid{.grid = {nx, ny, nz}};
  const std::size_t lines = 2 * 4 * 2 + 3 * 3 * 2 + 3 * 4 * 1, faces = 2 * 3 * 2 + 2 * 4 * 1 + 3 * 3 * 1,
                    cells = 2 * 3;
  auto only = [&](Grid3 springs) { return ready(springs, mesh.positions, grid); };
  CHECK(count(only({.stiffness = 0, .damping = 0, .linesStiffness = 1})) == lines);
  CHECK(count(only({.stiffness = 0, .damping = 0, .quadsStiffness = 1})) == 2 * faces);
  CHECK(count(only({.stiffness = 0, .damping = 0, .cubesStiffness = 1})) == 4 * cells);
  const auto all = stiffnesses(only({.linesStiffness = 1, .quadsStiffness = 2, .cubesStiffness = 3}));
  CHECK(all.size() == lines + 2 * faces + 4 * cells);
  for (auto const& [ends, k] : all) {  // lengths 1, sqrt 2, sqrt 3
    const double length =
        (mesh.positions[std::size_t(ends[0])] - mesh.positions[std::size_t(ends[1])]).norm();
    CHECK(length < 1.8);
    CHECK(k * length == Approx(std::round(length * length)));
  }
  // the hexahedra of the same grid have the same springs
  const TopologyView cellsOnly{.hexahedra = mesh.hexahedra};
  CHECK(stiffnesses(ready(Grid3{.linesStiffness = 1, .quadsStiffness = 2, .cubesStiffness = 3},
                          mesh.positions,
                          cellsOnly)) == all);
  // a sheet has no cell
  Mesh sheet = regular_grid(5, 4, 2, {0, 0, 0}, {4, 3, 1});
  sheet.positions.resize(5 * 4);
  CHECK(count(ready(Grid3{}, sheet.positions, {.grid = {5, 4, 1}})) == 4 * 4 + 5 * 3 + 2 * 4 * 3);
}

TEST_CASE("of a mesh without springs it is said that there is none, and nothing acts") {
  for (auto const& [stiffness, topology] :
       {std::pair{1.0, TopologyView{}}, {0.0, TopologyView{.edges = edges}}}) {
    auto springs = ready(Mesh3{.stiffness = stiffness}, corners, topology);
    CHECK(springs.warning().starts_with("there is no spring"));
    Vec3d::VecCoord moved = corners;
    moved[0] *= 3;
    for (auto const& f : one::force(springs, moved)) CHECK(f.norm() == 0);
  }
  CHECK(ready(Mesh3{.stiffness = 1}, corners, {.edges = edges}).warning().empty());
  auto grid = ready(Grid3{}, corners, {});
  CHECK(grid.warning().starts_with("there is no spring"));
  for (auto const& f : one::force(grid, corners)) CHECK(f.norm() == 0);
  CHECK(ready(Grid3{}, corners, {.grid = {2, 2, 1}}).warning().empty());
}

TEST_CASE("springs of meshes refuse what they cannot stand on") {
  one::refuses(Mesh3{.stiffness = -1}, corners, {.edges = edges}, {"stiffness is -1 N", "at least 0"});
  one::refuses(Mesh3{.cubesDamping = one::notANumber}, corners, {.edges = edges}, {"cubesDamping is nan"});
  const std::vector<Edge> far{{0, 4}};
  one::refuses(Mesh3{.stiffness = 1}, corners, {.edges = far}, {"edge 0 refers to point 4", "4 points"});
  const std::vector<QuadraticTetrahedron> ten{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
  Vec3d::VecCoord nodes(corners);
  nodes.resize(10, Eigen::Vector3d::Zero());
  one::refuses(Mesh3{.stiffness = 1},
               nodes,
               {.quadraticTetrahedra = ten},
               {"the topology has a quadratic tetrahedron, and this takes no elements of second order"});
  one::refuses(Grid3{}, corners, {.grid = {2, 2, 2}}, {"grid has 2 x 2 x 2 points", "state has 4"});
  one::refuses(Grid3{}, corners, {.hexahedra = cube}, {"hexahedron 0 refers to point 4"});
  one::refuses(Grid3{.quadsStiffness = -2}, corners, {.grid = {2, 2, 1}}, {"quadsStiffness is -2"});
}

}  // namespace test_mesh_springs
