// SPDX-License-Identifier: BSL-1.0
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include "catch.hpp"
#include "error_of.hpp"
#include "quadratic_mesh.hpp"

namespace test_diagonal_mass {

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

TEST_CASE("DiagonalMass of prisms and pyramids: a sixth to each corner; a quarter to the apex") {
  const std::vector<Eigen::Vector3d> corners{
      {0, 0, 0}, {2, 0, 0}, {0.5, 1.5, 0}, {0, 0.3, 4}, {2, 0.3, 4}, {0.5, 1.8, 4}};
  const std::vector<Prism> prisms{{0, 1, 2, 3, 4, 5}};
  for (const double m : masses({.massDensity = 2}, corners, {.prisms = prisms}))
    CHECK(m == Approx(2 * 6 / 6.).epsilon(1e-13));
  const std::vector<Eigen::Vector3d> tent{{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0.5, 1, 0}, {3, 4, 3}};
  const std::vector<Pyramid> pyramids{{0, 1, 2, 3, 4}};
  const auto m = masses({.massDensity = 8}, tent, {.pyramids = pyramids});
  for (std::size_t i = 0; i < 4; ++i) CHECK(m[i] == Approx(16 * 3 / 16.).epsilon(1e-13));
  CHECK(m[4] == Approx(16 / 4.).epsilon(1e-13));
}

// The diagonal of the consistent mass, in proportion: of a straight tetrahedron it is 6 at corners and 32
// between them, in rho V/420, which are 216 in all; of a box of 27 nodes the products of 1, 4 and 1 each way.
TEST_CASE("DiagonalMass of elements of second order is positive, and all of their mass") {
  const Mesh tetrahedra = one::quadratic<QuadraticTetrahedron>(
      {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, .tetrahedra = {{0, 1, 2, 3}}});
  const auto t = masses(
      {.massDensity = 216}, tetrahedra.positions, {.quadraticTetrahedra = tetrahedra.quadraticTetrahedra});
  for (std::size_t i = 0; i < 10; ++i) CHECK(t[i] == Approx(i < 4 ? 6 : 32).epsilon(1e-13));
  const Mesh box27 = one::quadratic_box<TriquadraticHexahedron>(1, 1, 1, {0, 0, 0}, {1, 2, 3});
  const auto h =
      masses({.massDensity = 36}, box27.positions, {.triquadraticHexahedra = box27.triquadraticHexahedra});
  auto const& e = box27.triquadraticHexahedra[0];
  for (std::size_t k = 0; k < 27; ++k) {
    const int middles = k < 8 ? 0 : k < 20 ? 1 : k < 26 ? 2 : 3;
    CHECK(h[std::size_t(e[k])] == Approx(std::pow(4, middles)).epsilon(1e-13));
  }
  const Mesh box20 = one::quadratic_box<QuadraticHexahedron>(2, 1, 1, {0, 0, 0}, {1, 2, 3});
  const auto s =
      masses({.massDensity = 5}, box20.positions, {.quadraticHexahedra = box20.quadraticHexahedra});
  CHECK(sum(s) == Approx(30).epsilon(1e-13));
  for (const double m : s) CHECK(m > 0);
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
  CHECK(said({.edges = edge}).empty());
  CHECK(contains(said({.edges = outside}), "edge 0 refers to point 3, but there are 3 points"));
  CHECK(contains(said({.edges = negative}), "edge 0 refers to point -1"));
  CHECK(contains(said({.triangles = flat}), "mass of point 0 is 0 kg"));
}

TEST_CASE("a point that no element has has no mass, stays where no force acts, and says where one does") {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Edge> edge{{0, 1}};
  DiagonalMass<Vec3d> mass{.massDensity = 2};
  mass.init(InitContext<Vec3d>{"/root", x, {.edges = edge}});
  CHECK(mass.lumped.totalMass(3) == Approx(2));
  CHECK(contains(mass.warning(), "no element has point 2"));
  MechanicalParams p;
  p.gravity = {0, -10, 0};
  std::vector<Eigen::Vector3d> f(3, Eigen::Vector3d::Zero()), a = f;
  mass.addForce(p, f, x, a);
  CHECK(f[2].norm() == 0);
  mass.accFromF(a, x, f);
  CHECK(a[0] == Eigen::Vector3d(0, -10, 0));
  CHECK(a[2].norm() == 0);
  f[2] = {1, 0, 0};
  CHECK(contains(error_of([&] { mass.accFromF(a, x, f); }), "point 2 has a force and no mass"));
}

}  // namespace test_diagonal_mass
