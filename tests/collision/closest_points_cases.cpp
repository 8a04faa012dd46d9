// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "collision/simplex_pairs.hpp"

#include <sinew/collision/proximity.hpp>

#include <limits>

namespace test_closest_points_cases {

using namespace sinew;
using namespace simplex_pairs;

namespace {

using V = Vec<double, 3>;
using Point = Simplex<double, 1>;
using Segment = Simplex<double, 2>;
using Triangle = Simplex<double, 3>;
const Triangle floorTriangle{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0)};

__extension__ typedef __float128 Quad;

/// Twice the digits: also where long double is no better than the square root of its epsilon.
template <std::size_t NA, std::size_t NB>
double largest_error(int pairs) {
  PairMaker<double, NA, NB> maker{std::mt19937_64(100 + NA * 10 + NB)};
  double worst = 0;
  Simplex<double, NA> a;
  Simplex<double, NB> b;
  for (int i = 0; i < pairs; ++i) {
    maker.make(a, b);
    const auto c = closest_points(a, b);
    const Quad square = brute_squared_distance(to<Quad>(a, a[0]), to<Quad>(b, a[0]));
    // sqrt(x) - sqrt(y) = (x - y) / (sqrt(x) + sqrt(y))
    const double sum = std::sqrt(c.squaredDistance) + std::sqrt(double(square));
    const double error = sum > 0 ? std::abs(double(Quad(c.squaredDistance) - square)) / sum : 0;
    const double unit = 0x1p-52 * std::max(detail::contact_size<double, NA, NB>(a, b), 1e-30);
    if (!(error / unit <= worst)) worst = error / unit;
  }
  return worst;
}

template <std::size_t NA, std::size_t NB>
V direction(Simplex<double, NA> const& a, Simplex<double, NB> const& b) {
  const auto c = closest_points(a, b);
  const V n = contact_direction(a, b, c);
  CHECK(n.norm() == Approx(1).epsilon(1e-14));
  return n;
}

}  // namespace

TEST_CASE("the distance of random pairs is that in quadruple precision", "[collision]") {
  const int pairs = brief ? 300 : 5000;
  // 6 roundings of the size, as in closest_points.cpp
  CHECK(largest_error<1, 2>(pairs) < 6);
  CHECK(largest_error<1, 3>(pairs) < 6);
  CHECK(largest_error<2, 2>(4 * pairs) < 6);
  CHECK(largest_error<2, 3>(4 * pairs) < 6);
  CHECK(largest_error<3, 3>(pairs) < 6);
}

TEST_CASE("closest points lie where features meet", "[collision]") {
  SECTION("over the inside of a face, an edge, a corner") {
    auto c = closest_points(Point{V(1, 1, 3)}, floorTriangle);
    CHECK(c.squaredDistance == 9);
    CHECK(c.weightsB == V(0.5, 0.25, 0.25));
    CHECK(c.pointB == V(1, 1, 0));
    CHECK(c.weightsA == V(1, 0, 0));
    c = closest_points(Point{V(2, -3, 4)}, floorTriangle);
    CHECK(c.squaredDistance == 25);
    CHECK(c.weightsB == V(0.5, 0.5, 0));
    c = closest_points(Point{V(6, 0, 0)}, floorTriangle);
    CHECK(c.squaredDistance == 4);
    CHECK(c.weightsB == V(0, 1, 0));
    CHECK(c.pointB == floorTriangle[1]);
  }
  SECTION("beyond an obtuse corner the nearest edge need not be the one that p lies behind") {
    const Triangle obtuse{V(0, 0, 0), V(10, 0, 0), V(-10, 1, 0)};
    const auto c = closest_points(Point{V(-5, -0.5, 0)}, obtuse);
    CHECK(c.weightsB[1] == 0);
    CHECK(c.weightsB[2] > 0);
  }
  SECTION("edges that cross at a height") {
    const auto c = closest_points(Segment{V(-1, 0, 2), V(1, 0, 2)}, Segment{V(0, -1, 0), V(0, 3, 0)});
    CHECK(c.squaredDistance == 4);
    CHECK(c.weightsA == V(0.5, 0.5, 0));
    CHECK(c.weightsB == V(0.75, 0.25, 0));
  }
  SECTION("a segment through a triangle, triangles through each other") {
    const auto c = closest_points(Segment{V(1, 1, -1), V(1, 1, 3)}, floorTriangle);
    CHECK(c.squaredDistance == 0);
    CHECK(c.pointA == V(1, 1, 0));
    CHECK(c.pointB == V(1, 1, 0));
    const Triangle upright{V(1, 1, -1), V(1, 1, 3), V(9, 9, 1)};
    const auto through = closest_points(upright, floorTriangle);
    CHECK(through.squaredDistance == 0);
    CHECK(std::abs(through.pointA[2]) < 1e-15);
  }
  SECTION("swapped, the distance is the same") {
    PairMaker<double, 3, 2> maker{std::mt19937_64(5)};
    Triangle a;
    Segment b;
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
      maker.make(a, b);
      const double d =
          std::sqrt(closest_points(a, b).squaredDistance) - std::sqrt(closest_points(b, a).squaredDistance);
      const double unit = contact_tolerance(a, b);
      if (unit > 0) worst = std::max(worst, std::abs(d) / unit);
    }
    CHECK(worst < 6. / 16);
  }
  SECTION("points that are no numbers have no distance, and no weight that is no number") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto c =
        closest_points(Triangle{V(nan, 0, 0), V(1, 0, 0), V(0, 1, 0)}, Segment{V(nan, nan, nan), V(0, 0, 0)});
    CHECK((c.squaredDistance >= 0));
    CHECK(c.weightsA.sum() == 1);
    CHECK(c.weightsB.sum() == 1);
  }
}

TEST_CASE("contact_direction points from a to b, and has an answer where they touch", "[collision]") {
  SECTION("apart: along the distance") {
    CHECK(direction(Point{V(1, 1, 3)}, floorTriangle) == V(0, 0, -1));
    CHECK(direction(floorTriangle, Point{V(1, 1, 3)}) == V(0, 0, 1));
    // much nearer than the size, and still no zero
    CHECK(direction(floorTriangle, Point{V(1, 1, 1e-13)}) == V(0, 0, 1));
  }
  SECTION("a point in a triangle: its normal") {
    CHECK(std::abs(direction(Point{V(1, 1, 0)}, floorTriangle)[2]) == 1);
  }
  SECTION("a segment that ends in a triangle: the normal towards the triangle") {
    CHECK(direction(Segment{V(1, 1, 0), V(2, 2, 5)}, floorTriangle) == V(0, 0, -1));
    CHECK(direction(floorTriangle, Segment{V(1, 1, 0), V(2, 2, 5)}) == V(0, 0, 1));
  }
  SECTION("edges that cross: their cross product") {
    const Segment x{V(-1, 0, 0), V(1, 0, 0)}, y{V(0, -1, 0), V(0, 1, 0)};
    CHECK(std::abs(direction(x, y)[2]) == 1);
    const Triangle below{V(0, -1, 0), V(0, 1, 0), V(0, 0, -2)};
    CHECK(direction(x, below) == V(0, 0, -1));
  }
  SECTION("a corner on an edge: between the middles, across the edge") {
    CHECK(direction(Segment{V(0, 0, 0), V(3, 2, 0)}, Segment{V(-1, 0, 0), V(1, 0, 0)}) == V(0, -1, 0));
  }
  SECTION("corners: between the middles") {
    CHECK(direction(Segment{V(0, 0, 0), V(0, -2, 0)}, Segment{V(0, 0, 0), V(0, 4, 0)}) == V(0, 1, 0));
  }
  SECTION("collinear and overlapping, the same, or points: a perpendicular, or any") {
    const Segment x{V(-1, 0, 0), V(1, 0, 0)};
    CHECK(direction(x, x)[0] == 0);
    CHECK(direction(Segment{V(0, 0, 0), V(3, 0, 0)}, x)[0] == 0);
    CHECK(direction(Point{V(0, 0, 0)}, x)[0] == 0);
    CHECK(direction(Point{V(1, 2, 3)}, Point{V(1, 2, 3)}) == V(0, 0, 1));
    direction(Segment{V(1, 2, 3), V(1, 2, 3)}, Triangle{V(1, 2, 3), V(1, 2, 3), V(1, 2, 3)});
    direction(Triangle{V(0, 0, 0), V(1, 1, 1), V(2, 2, 2)}, Triangle{V(0, 0, 0), V(3, 3, 3), V(1, 1, 1)});
    CHECK(std::abs(direction(floorTriangle, floorTriangle)[2]) == 1);
  }
}

namespace {

template <std::size_t NA, std::size_t NB>
void never_parts_what_is_near() {
  std::mt19937_64 random(NA * 10 + NB);
  std::normal_distribution<double> normal;
  int far = 0, told = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<Eigen::Vector3d, NA> a;
    std::array<Eigen::Vector3d, NB> b;
    const Eigen::Vector3d shift = 3 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    for (auto& x : a) x = Eigen::Vector3d(normal(random), normal(random), normal(random));
    for (auto& x : b) x = shift + Eigen::Vector3d(normal(random), normal(random), normal(random));
    if (NA == 3 && i % 7 == 0) a[2 % NA] = a[0];  // without a normal
    const double distance = std::sqrt(closest_points(a, b).squaredDistance);
    // as near to its limit as rounding allows
    CHECK_FALSE(are_apart(a, b, distance * (1 + 1e-9)));
    if (distance <= 0.5) continue;
    ++far;
    told += are_apart(a, b, 0.5);
  }
  CHECK(told > 0.95 * far);
}

}  // namespace

TEST_CASE("no plane parts primitives that are within reach, and one parts nearly all others") {
  never_parts_what_is_near<1, 3>();
  never_parts_what_is_near<2, 2>();
  never_parts_what_is_near<2, 3>();
  never_parts_what_is_near<3, 3>();
}

}  // namespace test_closest_points_cases
