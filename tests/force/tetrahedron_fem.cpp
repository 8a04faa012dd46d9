// SPDX-License-Identifier: BSL-1.0
#include <sinew/core/element_force.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/sphere_grid_topology.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_tetrahedron_fem {

using namespace sinew;

namespace {

bool contains(std::string_view said, std::string_view words) { return said.find(words) != said.npos; }

RegularGridTopology box(std::array<int, 3> n, Eigen::Vector3d const& hi) {
  RegularGridTopology grid{.n = n, .min = {0, 0, 0}, .max = hi};
  grid.generate("test");
  return grid;
}

}  // namespace

TEST_CASE("TetrahedronFEMForceField over hexahedra is that over six tetrahedra in each") {
  const auto grid = box({3, 4, 3}, {1, 1.5, 0.7});
  const std::vector<Tetrahedron> split =
      hexahedra_to_tetrahedra(grid.hexahedra, {.points = {3, 4, 3}, .swapping = true}, 0);
  std::vector<Eigen::Vector3d> x = grid.position;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.05 * Eigen::Vector3d(std::sin(3.0 * double(i)), std::cos(double(i)), std::sin(double(i)));
  auto forces = [&](TopologyView const& topology) {
    TetrahedronFEMForceField<Vec3d> fem{.youngModulus = {1000}, .poissonRatio = 0.3};
    fem.init(InitContext<Vec3d>{"/root", grid.position, topology});
    std::vector<Eigen::Vector3d> f(x.size(), Eigen::Vector3d::Zero());
    add_force(fem, {}, f, x, f);
    return f;
  };
  const auto f = forces(grid.view());
  CHECK(f == forces({.tetrahedra = split}));
  double largest = 0;
  for (auto const& each : f) largest = std::max(largest, each.norm());
  CHECK(largest > 1);
}

TEST_CASE(
    "TetrahedronFEMForceField fills a ball of hexahedra, which SOFA's cut would turn inside out at its rim") {
  SphereGridTopology ball{.n = {5, 5, 5}, .radius = 2};
  ball.generate("");
  TetrahedronFEMForceField<Vec3d> fem{.youngModulus = {1000}, .poissonRatio = 0.3};
  CHECK(error_of([&] { fem.init(InitContext<Vec3d>{"/root", ball.position, ball.view()}); }).empty());
  auto hexahedra = ball.hexahedra;
  hexahedra[3][2] = 999;
  CHECK(contains(error_of([&] {
                   fem.init(InitContext<Vec3d>{"/root", ball.position, {.hexahedra = hexahedra}});
                 }),
                 "hexahedron 3 refers to point 999"));
}

TEST_CASE("a grid of hexahedra stretched evenly has the stiffness of its material") {
  // uniform strain e along z, sides free to be drawn in by Poisson's ratio: stress E e, force E e A on the
  // end
  const double young = 2000, poisson = 0.3, strain = 1e-3;
  const auto grid = box({4, 3, 5}, {0.3, 0.2, 0.8});
  TetrahedronFEMForceField<Vec3d> fem{
      .youngModulus = {young}, .poissonRatio = poisson, .method = RotationMethod::small};
  fem.init(InitContext<Vec3d>{"/root", grid.position, grid.view()});
  std::vector<Eigen::Vector3d> x = grid.position, f(x.size(), Eigen::Vector3d::Zero());
  for (auto& p : x)
    p = p.cwiseProduct(Eigen::Vector3d(1 - poisson * strain, 1 - poisson * strain, 1 + strain));
  add_force(fem, {}, f, x, f);
  Eigen::Vector3d pull(0, 0, 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (grid.position[i][2] == 0.8)
      pull += f[i];
    else if (grid.position[i][2] > 0)
      CHECK(f[i].norm() < 1e-12 * young);
  CHECK(pull[2] == Approx(-young * strain * 0.06));
}

TEST_CASE("TetrahedronFEMForceField says what is wrong with hexahedra") {
  auto grid = box({3, 2, 2}, {1, 1, 1});
  auto said = [&] {
    TetrahedronFEMForceField<Vec3d> fem;
    return error_of([&] { fem.init(InitContext<Vec3d>{"/root", grid.position, grid.view()}); });
  };
  CHECK(said().empty());
  const auto good = grid.hexahedra;
  grid.hexahedra[1][3] = 12;
  CHECK(contains(said(), "refers to point 12"));
  grid.hexahedra = good;
  std::swap(grid.hexahedra[1][0], grid.hexahedra[1][4]),
      std::swap(grid.hexahedra[1][1], grid.hexahedra[1][5]);
  std::swap(grid.hexahedra[1][2], grid.hexahedra[1][6]),
      std::swap(grid.hexahedra[1][3], grid.hexahedra[1][7]);
  CHECK(contains(said(), "tetrahedron 6 is inside out"));
  grid.hexahedra.clear();
  CHECK(contains(said(), "give the node a topology with tetrahedra or hexahedra"));
}

}  // namespace test_tetrahedron_fem
