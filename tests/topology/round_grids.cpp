// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/cube_topology.hpp>
#include <sinew/topology/cylinder_grid_topology.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/sphere_grid_topology.hpp>

#include "catch.hpp"
#include "mesh_checks.hpp"

#include <numbers>

namespace test_round_grids {

using namespace sinew;

namespace {

constexpr double pi = std::numbers::pi;

template <class T>
T made(T topology) {
  check_fields(topology, "/root");
  topology.generate("/root");
  return topology;
}
template <class T>
std::string refusal(T const& topology) {
  return error_of([&] { made(topology); });
}
/// Volume inside the surface that the cells leave.
template <class T>
double volume(T const& grid) {
  Mesh mesh{.positions = grid.position, .tetrahedra = hexahedra_to_tetrahedra(grid.hexahedra)};
  CHECK(is_conforming(mesh));
  CHECK(quality(mesh).minVolume > 0);
  return quality(mesh).volume;
}
Mesh surface(CubeTopology const& cube) {
  Mesh mesh{.positions = cube.position};
  for (auto const& q : cube.quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

}  // namespace

TEST_CASE("CylinderGridTopology: squares squeezed to disks, along any axis") {
  const CylinderGridTopology settings{
      .n = {5, 5, 4}, .center = {1, 2, 3}, .axis = {0, 3, 4}, .radius = 2, .length = 6};
  const auto grid = made(settings);
  REQUIRE(grid.position.size() == 100);
  CHECK(grid.view().grid == std::array<int, 3>{5, 5, 4});
  const Eigen::Vector3d axis(0, 0.6, 0.8);
  for (std::size_t i = 0; i < 100; ++i) {
    const int x = int(i) % 5, y = int(i) / 5 % 5, z = int(i) / 25;
    const Eigen::Vector3d p = grid.position[i] - settings.center;
    CHECK(p.dot(axis) == Approx(6. * z / 3).margin(1e-14));
    // rings of squares are circles
    const double ring = std::max(std::abs(x - 2), std::abs(y - 2)) / 2.;
    CHECK((p - p.dot(axis) * axis).norm() == Approx(2 * ring).margin(1e-14));
  }
  // the first direction is as near to x as can be
  CHECK((grid.position[14] - grid.position[10] - Eigen::Vector3d(4, 0, 0)).norm() < 1e-14);
  // elements as those of a box of this size
  auto box = made(RegularGridTopology{.n = {5, 5, 4}});
  CHECK(grid.hexahedra == box.hexahedra);
  CHECK(grid.quads == box.quads);
  CHECK(grid.triangles == box.triangles);
  CHECK(grid.edges == box.edges);
}

TEST_CASE("the volume of finer cylinders and balls comes to that of the round body, to second order") {
  double errors[2][2];
  for (int k = 0; k < 2; ++k) {
    const int n = k == 0 ? 9 : 17;
    errors[0][k] = pi - volume(made(CylinderGridTopology{.n = {n, n, 2}}));
    errors[1][k] = 4 * pi / 3 - volume(made(SphereGridTopology{.nx = n, .ny = n, .nz = n}));
  }
  for (auto const& [coarse, fine] : errors) {
    CHECK(fine > 0);
    CHECK(coarse / fine == Approx(4).margin(0.3));
  }
}

TEST_CASE("SphereGridTopology: cubes squeezed to spheres") {
  const auto grid =
      made(SphereGridTopology{.n = {5, 5, 5}, .center = {1, 0, 0}, .axis = {-1, 0, 0}, .radius = 3});
  for (std::size_t i = 0; i < 125; ++i) {
    const int x = int(i) % 5, y = int(i) / 5 % 5, z = int(i) / 25;
    const double shell = std::max({std::abs(x - 2), std::abs(y - 2), std::abs(z - 2)}) / 2.;
    CHECK((grid.position[i] - Eigen::Vector3d(1, 0, 0)).norm() == Approx(3 * shell).margin(1e-14));
  }
  // the third direction is the axis
  CHECK((grid.position[112] - Eigen::Vector3d(-2, 0, 0)).norm() < 1e-14);
  CHECK(volume(grid) > 0);
}

TEST_CASE("CubeTopology is the surface of a box") {
  const CubeTopology settings{.nx = 4, .ny = 3, .nz = 5, .min = {0, 0, 0}, .max = {3, 4, 8}, .xmin = 1};
  const auto cube = made(settings);
  // 4 x 3 above and below, rings of 10 between
  REQUIRE(cube.position.size() == 2 * 12 + 3 * 10);
  CHECK(cube.quads.size() == 2 * (3 * 2 + 2 * 4 + 4 * 3));
  CHECK(cube.edges.size() == 2 * cube.quads.size());
  const auto q = surface_quality(surface(cube));
  CHECK(q.closed);
  CHECK(q.manifold);
  CHECK(q.eulerCharacteristic == 2);
  CHECK(q.area == Approx(2 * (2 * 4 + 4 * 8 + 8 * 2)));
  CHECK(q.volume == Approx(2 * 4 * 8));
  auto at = [&](std::size_t i, double x, double y, double z) {
    CHECK((cube.position[i] - Eigen::Vector3d(x, y, z)).norm() < 1e-14);
  };
  at(0, 1, 0, 0), at(3, 3, 0, 0), at(11, 3, 4, 0), at(12, 1, 0, 8);                     // layers
  at(24, 1, 0, 2), at(28, 1, 4, 2), at(32, 1, 2, 2), at(33, 3, 2, 2), at(34, 1, 0, 4);  // rings

  SECTION("with the points inside it is over those of a grid") {
    auto full = settings;
    full.internalPoints = true;
    full = made(full);
    const auto grid = made(RegularGridTopology{.n = {4, 3, 5}, .min = {1, 0, 0}, .max = {3, 4, 8}});
    CHECK(full.position == grid.position);
    CHECK(surface_quality(surface(full)).volume == Approx(2 * 4 * 8));
  }
  SECTION("with points of its own each face is plane, and an island") {
    auto split = settings;
    split.splitNormals = true;
    split = made(split);
    CHECK(split.position.size() == 2 * (12 + 15 + 20));
    const auto apart = surface_quality(surface(split));
    CHECK_FALSE(apart.closed);
    CHECK(apart.volume == Approx(2 * 4 * 8));
    CHECK(apart.eulerCharacteristic == 6);
    // points of lowest x first, then of lowest y, lowest z
    for (std::size_t i = 0; i < 15; ++i) CHECK(split.position[i][0] == 1);
    for (std::size_t i = 15; i < 35; ++i) CHECK(split.position[i][1] == 0);
    for (std::size_t i = 35; i < 47; ++i) CHECK(split.position[i][2] == 0);
    for (std::size_t i = 47; i < 62; ++i) CHECK(split.position[i][0] == 3);
    // the squares stand in the same order in any case
    for (std::size_t k = 0; k < cube.quads.size(); ++k)
      for (std::size_t c = 0; c < 4; ++c)
        CHECK(split.position[std::size_t(split.quads[k][c])] == cube.position[std::size_t(cube.quads[k][c])]);
  }
}

TEST_CASE("round grids and surfaces that make no sense are refused") {
  CHECK(contains(refusal(CylinderGridTopology{.axis = {0, 0, 0}}),
                 "/root: CylinderGridTopology: axis is zero"));
  CHECK(contains(refusal(CylinderGridTopology{.n = {1, 3, 3}}), "1 x 3 x 3 points cannot be round"));
  CHECK(contains(refusal(SphereGridTopology{.nz = 1}), "2 x 2 x 1 points cannot be round"));
  CHECK(contains(refusal(SphereGridTopology{.radius = 0}), "radius is 0"));
  CHECK(contains(refusal(CylinderGridTopology{.length = -1}), "length is -1"));
  CHECK(contains(refusal(SphereGridTopology{.n = {4000, 4000, 4000}}), "exceeds the limit"));
  CHECK(contains(refusal(CubeTopology{.nx = 1}), "nx is 1"));
  CHECK(contains(refusal(CubeTopology{.xmax = -1}), "/root: CubeTopology: the box"));
  CHECK(refusal(CylinderGridTopology{.n = {3, 3, 1}}).empty());  // a disk
}

}  // namespace test_round_grids
