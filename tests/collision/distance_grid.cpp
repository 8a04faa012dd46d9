// SPDX-License-Identifier: BSL-1.0
// Grids of signed distances against closed forms, and what is refused.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/collision/distance_grid.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace test_distance_grid {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

struct Random {
  std::mt19937 engine{7};
  double operator()(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }
  V in(AxisBox const& box) {
    V x;
    for (int c = 0; c < 3; ++c) x[c] = (*this)(box.min[c], box.max[c]);
    return x;
  }
};

struct Surface {
  std::vector<V> points;
  std::vector<Triangle> triangles;
};
Surface cube_mesh(double half) {
  Surface s;
  for (int i = 0; i < 8; ++i) s.points.push_back(half * V(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  for (std::array<int, 4> const& q :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    s.triangles.push_back({q[0], q[1], q[2]});
    s.triangles.push_back({q[0], q[2], q[3]});
  }
  return s;
}
DistanceGrid of(Surface const& s, GridLayout const& layout) {
  return grid_of_surface("mesh", s.points, s.triangles, {}, layout);
}
/// The largest errors of distances and of normals of a ball's grid, at places no nearer to its centre than
/// 0.4.
std::array<double, 2> errors(int n) {
  const DistanceGrid grid = grid_of_ball("ball", 1, {{0.1, 0.2, -0.3}, {}}, {.n = {n, n, n}});
  Random random;
  std::array<double, 2> worst{0, 0};
  for (int i = 0; i < 20000; ++i) {
    const V x = random.in(grid.box), from = x - V(0.1, 0.2, -0.3);
    if (from.norm() < 0.4) continue;
    const auto place = grid.nearest(x);
    worst[0] = std::max(worst[0], std::abs(place.distance - (from.norm() - 1)));
    worst[1] = std::max(worst[1], (place.normal - from.normalized()).norm());
    CHECK((place.point + place.distance * place.normal - x).norm() < 1e-14);
  }
  return worst;
}

}  // namespace

TEST_CASE("distances to a ball have errors of the square of the cell, normals of the cell") {
  const auto coarse = errors(25), fine = errors(49);
  // second derivatives of the distance are 1/r, twice: h^2/8 2/r at r = 0.4 - h
  const double h = 2.4 / 24;
  CHECK(coarse[0] < h * h / 4 / (0.4 - h));
  CHECK(coarse[0] / fine[0] > 3);
  CHECK(coarse[0] / fine[0] < 5);
  CHECK(coarse[1] / fine[1] > 1.6);
  CHECK(coarse[1] / fine[1] < 2.4);
}

TEST_CASE("beyond its box a grid knows how far the surface is") {
  const DistanceGrid grid = grid_of_ball("ball", 1, {}, {.n = {41, 41, 41}});
  const double h = grid.cell()[0];
  for (V const& x : {V(3, 0, 0), V(0, -1.5, 0), V(1.3, 1.2, -1.4)}) {
    const auto place = grid.nearest(x);
    // the nearest place of the nearest one in the box: no nearer than the surface, up to the error of that
    CHECK(place.distance > x.norm() - 1 - h * h);
    CHECK(place.distance < 1.1 * (x.norm() - 1));
    CHECK((place.point + place.distance * place.normal - x).norm() < 1e-14);
    CHECK(std::abs(place.point.norm() - 1) < h * h);
  }
  CHECK(grid.nearest({3, 0, 0}).distance == Approx(2).margin(h * h));
}

TEST_CASE("a closed mesh has the distances of its shape, turned and whichever way its triangles look") {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, V(1, 2, 3).normalized()));
  const GridLayout layout{.n = {21, 22, 23}, .box = {V(-2, -2, -2), V(2, 2, 2)}};
  const DistanceGrid exact = grid_of_cube("cube", 0.8, {{0.1, 0, -0.2}, q}, layout);
  Surface mesh = cube_mesh(0.8);
  for (V& x : mesh.points) x = q * x + V(0.1, 0, -0.2);
  Surface inward = mesh;
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  Surface apart;  // each triangle with corners of its own
  for (Triangle const& t : mesh.triangles) {
    for (const Index i : t) apart.points.push_back(mesh.points[std::size_t(i)]);
    const auto n = Index(apart.points.size());
    apart.triangles.push_back({n - 3, n - 2, n - 1});
  }
  for (Surface const& s : {mesh, inward, apart}) {
    const DistanceGrid grid = of(s, layout);
    REQUIRE(grid.values.size() == 21 * 22 * 23);
    for (std::size_t i = 0; i < grid.values.size(); ++i)
      CHECK(std::abs(grid.values[i] - exact.values[i]) < 1e-13);
    CHECK(grid.points.size() == 8);
  }
  // inside a face the distance is linear, and so exact
  const V x = q * V(1.1, 0.1, 0.2) + V(0.1, 0, -0.2);
  CHECK(exact.nearest(x).distance == Approx(0.3).epsilon(1e-13));
  CHECK((exact.nearest(x).normal - q * V(1, 0, 0)).norm() < 1e-13);
  CHECK(exact.nearest(q * V(0.6, 0.01, 0) + V(0.1, 0, -0.2)).distance == Approx(-0.2).epsilon(1e-13));
}

TEST_CASE("signs are right at acute edges and corners") {
  // a wedge of 6 degrees, and what is in it by its planes
  const Surface wedge{{{0, 0, 0}, {2, 0.1, 0}, {2, -0.1, 0}, {1.8, 0, 1}},
                      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const DistanceGrid grid = of(wedge, {.n = {31, 32, 33}, .box = {V(-1, -1, -1), V(3, 1, 2)}});
  const V h = grid.cell();
  std::size_t at = 0;
  for (int k = 0; k < 33; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 31; ++i) {
        const V x = grid.box.min + h.cwiseProduct(V(i, j, k));
        bool inside = true;
        for (Triangle const& t : wedge.triangles) {
          V const &a = wedge.points[std::size_t(t[0])], &b = wedge.points[std::size_t(t[1])],
                  &c = wedge.points[std::size_t(t[2])];
          V n = (b - a).cross(c - a);
          for (V const& p : wedge.points)
            if (n.dot(p - a) > 1e-9) n = -n;
          inside = inside && n.dot(x - a) < 0;
        }
        CHECK((grid.values[at++] < 0) == inside);
      }
}

TEST_CASE("a flipped grid is the room around its body") {
  DistanceGrid grid = grid_of_cube("cube", 1, {}, {.n = {21, 21, 21}});
  grid.flip();
  const auto place = grid.nearest({0.75, 0.1, 0});
  CHECK(place.distance == Approx(0.25));
  CHECK((place.normal - V(-1, 0, 0)).norm() < 1e-12);
  const auto beyond = grid.nearest({1.7, 0.1, 0});
  CHECK(beyond.distance == Approx(-0.7));
  CHECK((beyond.normal - V(-1, 0, 0)).norm() < 1e-12);
  CHECK(grid.around.max == grid.box.max);
}

TEST_CASE("grids that cannot be are refused") {
  auto refused = [](auto&& make, std::initializer_list<std::string_view> words) {
    const std::string message = error_of(make);
    for (const auto word : words) {
      INFO(message << "\nshould have: " << word);
      CHECK(message.find(word) != std::string::npos);
    }
  };
  Surface open = cube_mesh(1);
  open.triangles.pop_back();
  refused([&] { of(open, {}); }, {"mesh", "not closed", "close the holes"});
  Surface bad = cube_mesh(1);
  bad.points[3][1] = std::nan("");
  refused([&] { of(bad, {}); }, {"point 3", "not finite"});
  bad = cube_mesh(1);
  bad.triangles[0][0] = 8;
  refused([&] { of(bad, {}); }, {"triangle 0", "point 8", "8 points"});
  refused([&] { of({}, {}); }, {"no triangle"});
  refused([&] { grid_of_ball("a", 1, {}, {.n = {1, 4, 4}}); }, {"a grid of 1 points", "at least 2"});
  refused([&] { grid_of_ball("a", 1, {}, {.n = {2000, 2000, 2000}}); }, {"2000 x 2000 x 2000", "fewer"});
}

}  // namespace test_distance_grid
