// SPDX-License-Identifier: BSL-1.0
// Masses and elastic forces of bodies whose elements are not tetrahedra.
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/sphere_grid_topology.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_grid_bodies {

using namespace sinew;

namespace {

bool contains(std::string_view said, std::string_view words) { return said.find(words) != said.npos; }

RegularGridTopology box(std::array<int, 3> n, Eigen::Vector3d const& hi) {
  RegularGridTopology grid{.n = n, .min = {0, 0, 0}, .max = hi};
  grid.generate("test");
  return grid;
}

template <class D = Vec3d>
std::vector<double> masses(DiagonalMass<D> mass, typename D::VecCoord const& x,
                           TopologyView const& topology) {
  mass.init(InitContext<D>{"/root", x, topology});
  std::vector<double> list;
  for (std::size_t i = 0; i < x.size(); ++i) list.push_back(mass.lumped.at(i));
  return list;
}
double sum(std::vector<double> const& list) {
  double s = 0;
  for (const double m : list) s += m;
  return s;
}

}  // namespace

TEST_CASE("DiagonalMass of a grid of hexahedra: an eighth of each cell to each corner") {
  const auto grid = box({3, 4, 2}, {2, 1.5, 1});  // cells of 1 x 0.5 x 1
  const auto m = masses({.massDensity = 16}, grid.position, grid.view());
  CHECK(sum(m) == Approx(16 * 3));
  CHECK(m[0] == Approx(1));      // one cell of 8 kg
  CHECK(m[1] == Approx(2));      // two
  CHECK(m[3 + 1] == Approx(4));  // four, in a face
  CHECK(sum(masses({.totalMass = 7}, grid.position, grid.view())) == Approx(7));
}

TEST_CASE("DiagonalMass of a distorted hexahedron integrates density times shape functions") {
  // a frustum: bottom [-1, 1]^2, top [-1/2, 1/2]^2, height 1; V = (4 + 1 + 2) / 3, and the top four corners
  // share the integral of z over it, of area (2 - z)^2:  4/2 - 4/3 + 1/4
  std::vector<Eigen::Vector3d> x{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) x.push_back(x[i] / 2 + Eigen::Vector3d(0, 0, 1));
  const std::vector<Hexahedron> one{{0, 1, 2, 3, 4, 5, 6, 7}};
  const auto m = masses({.massDensity = 1}, x, {.hexahedra = one});
  const double top = 11.0 / 12;
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(m[i] == Approx((7.0 / 3 - top) / 4));
    CHECK(m[4 + i] == Approx(top / 4));
  }
}

TEST_CASE("DiagonalMass of sheets and strings") {
  const auto sheet = box({3, 2, 1}, {2, 3, 0});  // its quads, and not its triangles again
  const auto m = masses({.massDensity = 2}, sheet.position, sheet.view());
  CHECK(sum(m) == Approx(2 * 6));
  CHECK(m[0] == Approx(2 * 3 / 4.0));
  CHECK(m[1] == Approx(2 * 6 / 4.0));
  // without its quads, a third of each triangle to its points
  const auto t = masses({.massDensity = 2}, sheet.position, {.triangles = sheet.triangles});
  CHECK(sum(t) == Approx(12));
  CHECK(t[0] == Approx(2 * 3 / 3.0));
  // a surface of both, as files hold them
  const std::vector<Triangle> triangle{{0, 1, 4}, {0, 4, 3}};
  const std::vector<Quad> quad{{1, 2, 5, 4}};
  CHECK(sum(masses({.massDensity = 2}, sheet.position, {.triangles = triangle, .quads = quad})) ==
        Approx(12));

  const auto string = box({5, 1, 1}, {2, 0, 0});
  const auto s = masses({.massDensity = 3}, string.position, string.view());
  CHECK(sum(s) == Approx(6));
  CHECK(s[0] == Approx(0.75));
  CHECK(s[1] == Approx(1.5));
  // elements of the highest dimension count, the others not
  const std::vector<Tetrahedron> tetrahedron{{0, 1, 2, 3}};
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Triangle> face{{0, 1, 2}};
  CHECK(sum(masses({.massDensity = 6}, corners, {.triangles = face, .tetrahedra = tetrahedron})) ==
        Approx(1));
}

TEST_CASE("DiagonalMass in the plane and on a line") {
  const std::vector<Eigen::Vector2d> x{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  const std::vector<Quad> quad{{0, 1, 2, 3}};
  CHECK(masses<Vec2d>({.massDensity = 2}, x, {.quads = quad})[2] == Approx(1));
  const std::vector<Vec1d::Coord> line{Vec1d::Coord(0.0), Vec1d::Coord(3.0)};
  const std::vector<Edge> edge{{0, 1}};
  CHECK(masses<Vec1d>({.massDensity = 2}, line, {.edges = edge})[1] == Approx(3));
}

TEST_CASE("DiagonalMass says what is wrong with its elements") {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Edge> edge{{0, 1}}, outside{{0, 3}}, negative{{-1, 0}}, all{{0, 1}, {1, 2}};
  const std::vector<Triangle> flat{{0, 1, 2}};
  auto said = [&](TopologyView const& t) { return error_of([&] { masses({.massDensity = 1}, x, t); }); };
  CHECK(said({.edges = all}).empty());
  CHECK(contains(said({}), "/root: DiagonalMass<Vec3d>: a density needs elements"));
  CHECK(contains(said({.edges = edge}), "mass of point 2 is 0 kg"));
  CHECK(contains(said({.edges = outside}), "edge 0 refers to point 3, but there are 3 points"));
  CHECK(contains(said({.edges = negative}), "edge 0 refers to point -1"));
  CHECK(contains(said({.triangles = flat}), "mass of point 0 is 0 kg"));
}

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

}  // namespace test_grid_bodies
