// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/bending_springs.hpp>
#include <sinew/force/fast_triangular_bending_springs.hpp>

#include <numbers>

namespace test_bending_springs {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;
using std::numbers::pi;

namespace {

using Fast = FastTriangularBendingSprings<Vec3d>;

// two triangles of height h at an edge of length l along x, folded by an angle from flat, the far points
// `shift` along the edge
Vec3d::VecCoord hinge(double l, double h, double angle, double shift = 0) {
  const double c = h * std::cos(angle / 2), s = h * std::sin(angle / 2);
  return {{0, 0, 0}, {l, 0, 0}, {shift, c, s}, {shift, -c, s}};
}
const std::vector<sinew::Triangle> pair{{0, 1, 2}, {1, 0, 3}};

template <class C>
std::vector<std::array<int, 2>> springs(C const& c) {
  std::vector<std::array<int, 2>> ends;
  for (auto const& pack : c.driver.packs)
    for (int l = 0; l < pack.active; ++l) ends.push_back({pack.index[0][l], pack.index[1][l]});
  return ends;
}
using Ends = std::vector<std::array<int, 2>>;

}  // namespace

TEST_CASE("hinges are the edges that two faces share") {
  // a fan of three triangles, and a quad beside it
  const std::vector<sinew::Triangle> fan{{0, 1, 2}, {0, 2, 3}, {3, 4, 0}};
  const std::vector<sinew::Quad> quad{{1, 0, 5, 6}};
  const auto hinges = find_hinges(fan, quad);
  REQUIRE(hinges.size() == 3);
  CHECK((hinges[0].a == 0 && hinges[0].b == 1));
  CHECK(hinges[0].next[0] == std::array{2, 2});
  CHECK(hinges[0].next[1] == std::array{5, 6});  // beside 0, beside 1
  CHECK((hinges[1].a == 0 && hinges[1].b == 2));
  CHECK(hinges[1].next[0] == std::array{1, 1});
  CHECK(hinges[1].next[1] == std::array{3, 3});
  CHECK((hinges[2].a == 0 && hinges[2].b == 3));
  // an edge of three faces is none
  const std::vector<sinew::Triangle> book{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  CHECK(find_hinges(book).empty());
}

TEST_CASE("springs across the edges of triangles have the energy of a hinge") {
  const double l = 2, h = 0.7, k = 30;
  auto bending = ready(
      TriangularBendingSprings<Vec3d>{.stiffness = k, .damping = 0}, hinge(l, h, 0), {.triangles = pair});
  CHECK(springs(bending) == Ends{{2, 3}});
  for (const double angle : {0.0, 0.1, 1.0, 2.5, pi}) {
    const double shorter = 2 * h * (1 - std::cos(angle / 2));
    const auto x = hinge(l, h, angle);
    CHECK(potential_energy(bending, x) == Approx(k / 2 * shorter * shorter).margin(1e-14));
    // the points are pushed apart along the line between them; at pi they are in one place, without direction
    if (angle < 3) CHECK((force(bending, x)[2] - Vector3d(0, k * shorter, 0)).norm() < 1e-12);
  }
  // relaxed where it rests, folded or not
  auto folded = ready(TriangularBendingSprings<Vec3d>{}, hinge(l, h, 1), {.triangles = pair});
  CHECK(potential_energy(folded, hinge(l, h, 1)) == 0);
  CHECK(folded.stiffness == 1e5);
  CHECK(folded.damping == 1);
}

TEST_CASE("the four classes take the faces that SOFA's do") {
  // 3 4 5
  // 0 1 2
  const Vec3d::VecCoord x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  const std::vector<sinew::Quad> quads{{0, 1, 4, 3}, {1, 2, 5, 4}};
  const std::vector<sinew::Triangle> triangles{{0, 1, 4}, {0, 4, 3}};
  CHECK(springs(ready(QuadBendingSprings<Vec3d>{}, x, {.quads = quads})) == Ends{{0, 2}, {3, 5}});
  CHECK(springs(ready(QuadularBendingSprings<Vec3d>{}, x, {.quads = quads})) == Ends{{0, 2}, {3, 5}});
  CHECK(springs(ready(TriangularBendingSprings<Vec3d>{}, x, {.triangles = triangles, .quads = quads})) ==
        Ends{{1, 3}});
  // edges 04 and 14 and 15 of the halves
  CHECK(springs(ready(TriangleBendingSprings<Vec3d>{}, x, {.quads = quads})) == Ends{{1, 3}, {0, 5}, {2, 4}});
  // the quads of a grid are its triangles
  CHECK(springs(ready(TriangleBendingSprings<Vec3d>{},
                      x,
                      {.triangles = triangles, .quads = quads, .grid = {3, 2, 1}})) == Ends{{1, 3}});
  CHECK(TriangleBendingSprings<Vec3d>{}.stiffness == 100);
  CHECK(QuadBendingSprings<Vec3d>{}.damping == 5);
  CHECK(QuadularBendingSprings<Vec3d>{}.stiffness == 1e5);
}

TEST_CASE("a sheet of quads that is rolled up has the energy of its springs") {
  // n x m squares along x onto a cylinder of radius r: points two columns apart are 2 r sin(angle) apart
  const int n = 12, m = 4;
  const double angle = 0.2, r = 1 / (2 * std::sin(angle / 2)), k = 7;
  Vec3d::VecCoord flat, rolled;
  std::vector<sinew::Quad> quads;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      flat.push_back({double(i), double(j), 0});
      rolled.push_back({r * std::sin(i * angle), double(j), r * std::cos(i * angle)});
      const int p = i * (m + 1) + j;
      if (i < n && j < m) quads.push_back({p, p + m + 1, p + m + 2, p + 1});
    }
  const double shorter = 2 - 2 * r * std::sin(angle), each = k / 2 * shorter * shorter;
  // a spring at each point of the n - 1 columns inside, or one for each side of each square there
  auto once = ready(QuadBendingSprings<Vec3d>{.stiffness = k}, flat, {.quads = quads});
  CHECK(potential_energy(once, rolled) == Approx((n - 1) * (m + 1) * each));
  auto forEach = ready(QuadularBendingSprings<Vec3d>{.stiffness = k}, flat, {.quads = quads});
  CHECK(potential_energy(forEach, rolled) == Approx((n - 1) * 2 * m * each));
}

TEST_CASE("linear bending has the energy of the folded edge") {
  const double l = 2, h = 0.7, mu = 3;
  for (const double shift : {1.0, 0.3}) {
    auto bending = ready(Fast{.bendingStiffness = mu}, hinge(l, h, 0, shift), {.triangles = pair});
    for (const double angle : {0.0, 0.1, 1.0, 2.5}) {
      const auto x = hinge(l, h, angle, shift);
      const double s = std::sin(angle / 2);
      CHECK(potential_energy(bending, x) == Approx(2 * mu * l / (3 * h) * s * s).margin(1e-14));
      // equal forces on the far points, against the fold; those on the edge as their weights say
      const auto f = force(bending, x);
      CHECK((f[2] - f[3]).norm() < 1e-12);
      CHECK((f[2] - Vector3d(0, 0, -2 * mu * l / (3 * h * h) * s)).norm() < 1e-12);
      // shared by the ends of the edge as a lever shares them
      CHECK((f[0] + 2 * f[2] * (1 - shift / l)).norm() < 1e-12);
    }
    // flat triangles that are stretched in their plane as a whole feel nothing
    auto x = hinge(l, h, 0, shift);
    for (auto& p : x) p = Vector3d(1.3 * p[0] + 0.4 * p[1], 0.8 * p[1], 0);
    for (auto const& f : force(bending, x)) CHECK(f.norm() < 1e-12);
  }
}

TEST_CASE("a rolled sheet of equilateral triangles has a third of the bending stiffness") {
  // rows of triangles of height h across x, rolled with the angle a per row: sin(a/2) = h / (2 r) on the
  // cylinder through all points
  const int rows = 6, columns = 5;
  const double l = 1, h = std::sqrt(0.75), a = 0.05, mu = 2, r = h / (2 * std::sin(a / 2));
  Vec3d::VecCoord flat, rolled;
  std::vector<sinew::Triangle> triangles;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double y = l * (j + 0.5 * (i % 2));
      flat.push_back({i * h, y, 0});
      rolled.push_back({r * std::sin(i * a), y, r * std::cos(i * a)});
    }
  auto at = [&](int i, int j) { return i * (columns + 1) + j; };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i % 2 == 0)
        triangles.insert(
            triangles.end(),
            {{at(i, j), at(i + 1, j), at(i, j + 1)}, {at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)}});
      else
        triangles.insert(
            triangles.end(),
            {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  auto sheet = ready(Fast{.bendingStiffness = mu}, flat, {.triangles = triangles});
  // each of the edges inside across x stands for the area l h; the others stay flat. The curvature is 1/r up
  // to a^2 / 8
  const double area = (rows - 1) * columns * l * h;
  CHECK(potential_energy(sheet, rolled) == Approx(mu / 3 / 2 / (r * r) * area).epsilon(a * a));
}

TEST_CASE("surfaces that do not bend are refused") {
  const auto x = hinge(1, 1, 0);
  using Triangular = TriangularBendingSprings<Vec3d>;
  refuses(Triangular{}, x, {}, {"body", "TriangularBendingSprings<Vec3d>", "no two triangles share an edge"});
  refuses(QuadBendingSprings<Vec3d>{},
          x,
          {.triangles = pair},
          {"QuadBendingSprings<Vec3d>", "no two quads share"});
  const std::vector<sinew::Triangle> outside{{0, 1, 4}};
  refuses(Triangular{}, x, {.triangles = outside}, {"triangle 0 refers to point 4"});
  refuses(Triangular{.stiffness = -1}, x, {.triangles = pair}, {"stiffness is -1 N/m"});
  refuses(Triangular{.damping = one::notANumber}, x, {.triangles = pair}, {"damping is nan"});
  refuses(Fast{}, x, {}, {"FastTriangularBendingSprings<Vec3d>", "no two triangles share an edge"});
  refuses(Fast{}, x, {.triangles = outside}, {"triangle 0 refers to point 4"});
  refuses(Fast{.bendingStiffness = -1}, x, {.triangles = pair}, {"bendingStiffness is -1 N m"});
  refuses(Fast{.minDistValidity = 3}, x, {.triangles = pair}, {"larger than minDistValidity"});
  auto flat = x;
  flat[2] = {0.5, 0, 0};
  refuses(Fast{}, flat, {.triangles = pair}, {"triangle at the edge from point 0 to 1 has no area"});
}

}  // namespace test_bending_springs
