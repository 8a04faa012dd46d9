// SPDX-License-Identifier: BSL-1.0
// Where rays meet single primitives: against closed forms.
#include <sinew/collision/ray_hits.hpp>

#include <random>
#include <vector>
#include "catch.hpp"

namespace test_ray_hits {

using namespace sinew;
using Point = Eigen::Vector3d;

namespace {
struct Random {
  std::mt19937 engine{5};
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Point point(double r) { return {(*this)(-r, r), (*this)(-r, r), (*this)(-r, r)}; }
  Point direction() {
    Point d = point(1);
    while (d.norm() < 0.1 || d.norm() > 1) d = point(1);
    return d.normalized();
  }
};
}  // namespace

TEST_CASE("a ray enters a sphere, leaves it from inside, and misses what is beside or behind") {
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  CHECK(ray_sphere(ray, {0, 0, 1}, 2).distance == 2);
  CHECK(ray_sphere(ray, {0, 0, 5}, 2).distance == 2);
  CHECK(ray_sphere(ray, {0, 0, 6}, 2).distance == 1);
  CHECK(!ray_sphere(ray, {0, 0, 8}, 2));
  CHECK(!ray_sphere(ray, {2.001, 0, 0}, 2));
  CHECK(ray_sphere(ray, {2, 0, 0}, 2).distance == 5);  // touches
  Random random;
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray r{random.point(3), random.direction()};
    const Point c = random.point(2);
    const double radius = random(0.1, 1.5), along = (c - r.origin).dot(r.direction);
    const double beside = (c - r.at(along)).norm(), far = (c - r.origin).norm();
    const RayHit hit = ray_sphere(r, c, radius);
    // |r(t) - c| = radius at the hit; there is one where the line passes near enough, ahead or around
    REQUIRE(bool(hit) == (far < radius || (beside < radius && along > 0)));
    if (!hit) continue;
    ++hits;
    REQUIRE((r.at(hit.distance) - c).norm() == Approx(radius).epsilon(1e-12));
    const bool enters = (r.at(hit.distance) - c).dot(r.direction) < 0;
    REQUIRE(enters == (far > radius));
  }
  CHECK(hits > 500);
}

TEST_CASE("a ray meets a triangle from both sides at its barycentric weights, or passes it") {
  Random random;
  int hits = 0;
  for (int i = 0; i < 50000; ++i) {
    const std::array<Point, 3> p{random.point(1), random.point(1), random.point(1)};
    const Point n = (p[1] - p[0]).cross(p[2] - p[0]);
    if (n.norm() < 1e-2) continue;
    // a place in the plane of the triangle, with weights of its own, inside or outside
    const double a = random(-0.5, 1.5), b = random(-0.5, 1.5), c = 1 - a - b;
    const Point place = a * p[0] + b * p[1] + c * p[2];
    const double distance = random(-2, 4);
    Point d = random.direction();
    if (std::abs(d.dot(n.normalized())) < 0.05) continue;
    const double edge = std::min({std::abs(a), std::abs(b), std::abs(c)});
    if (edge < 1e-9 || std::abs(distance) < 1e-9) continue;
    const RayHit hit = ray_triangle({place - distance * d, d}, p, {7, 3, 5});
    REQUIRE(bool(hit) == (a > 0 && b > 0 && c > 0 && distance > 0));
    if (!hit) continue;
    ++hits;
    // rounding grows with the inverse of the area and of the slope: at most 1 / (1e-2 0.05) here
    REQUIRE(hit.distance == Approx(distance).margin(1e-11));
    REQUIRE(hit.weights[0] == Approx(a).margin(1e-11));
    REQUIRE(hit.weights[1] == Approx(b).margin(1e-11));
    REQUIRE(hit.weights[2] == Approx(c).margin(1e-11));
  }
  CHECK(hits > 1000);
}

TEST_CASE("a triangle seen from its edge, and one without area, are not hit") {
  const std::array<Point, 3> p{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  CHECK(!ray_triangle({{-1, 0.2, 0}, {1, 0, 0}}, p, {0, 1, 2}));
  CHECK(!ray_triangle({{-1, 0, 0}, {1, 0, 0}}, p, {0, 1, 2}));  // along an edge
  const std::array<Point, 3> line{Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0)};
  CHECK(!ray_triangle({{0.5, 0, 1}, {0, 0, -1}}, line, {0, 1, 2}));
  CHECK(ray_triangle({{0.25, 0.25, 1}, {0, 0, -1}}, p, {0, 1, 2}).distance == 1);
  CHECK(!ray_triangle({{0.2, 0.2, -1}, {0, 0, -1}}, p, {0, 1, 2}));
}

TEST_CASE("no ray slips between the triangles of a fan, through their edges and their common corner") {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    // four triangles around a corner, in a square seen from a point before it
    const Point middle(random(-0.3, 0.3), random(-0.3, 0.3), random(-0.2, 0.2));
    const std::array<Point, 5> p{middle, Point(-1, -1, 0), Point(1, -1, 0), Point(1, 1, 0), Point(-1, 1, 0)};
    const Point eye(random(-0.1, 0.1), random(-0.1, 0.1), random(2, 4));
    const std::size_t k = 1 + random.engine() % 4;
    const double s = i % 3 == 0 ? 0 : random(0, 0.9);
    const Point aim = middle + s * (p[k] - middle);
    const Ray ray{eye, (aim - eye).normalized()};
    int hits = 0;
    for (int t = 0; t < 4; ++t) {
      const int a = 1 + t, b = 1 + (t + 1) % 4;
      hits += bool(ray_triangle(ray, {p[0], p[std::size_t(a)], p[std::size_t(b)]}, {0, a, b}));
    }
    REQUIRE(hits >= 1);
  }
}

TEST_CASE("a ray passes a segment and a point within a tolerance") {
  Random random;
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{random.point(2), random.direction()};
    const std::array<Point, 2> p{random.point(2), random.point(2)};
    // the distance between the two by a search on both
    double minimum = 1e300;
    for (int k = 0; k <= 2000; ++k) {
      const Point q = p[0] + k / 2000.0 * (p[1] - p[0]);
      minimum = std::min(minimum, (q - ray.at(std::max(0.0, (q - ray.origin).dot(ray.direction)))).norm());
    }
    const double tolerance = random(0.05, 1);
    // the search misses the least by at most half of one of its steps
    if (std::abs(minimum - tolerance) < 2e-3) continue;
    const RayHit hit = ray_segment(ray, p, tolerance);
    REQUIRE(bool(hit) == (minimum < tolerance));
    if (!hit) continue;
    ++hits;
    const Point q = hit.weights[0] * p[0] + hit.weights[1] * p[1];
    REQUIRE((q - ray.at(hit.distance)).norm() <= minimum + 1e-9);
  }
  CHECK(hits > 500);
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  CHECK(ray_segment(ray, {Point(3, 0, 0), Point(2, 0, 0)}, 0).distance == 2);  // along it
  CHECK(ray_segment(ray, {Point(2, -1, 0), Point(2, 1, 0)}, 0).distance == 2);
  CHECK(ray_segment(ray, {Point(2, 0, 0), Point(2, 0, 0)}, 0).distance == 2);
  CHECK(!ray_segment(ray, {Point(-2, -1, 0), Point(-2, 1, 0)}, 0.5));
  CHECK(ray_point(ray, {4, 0.5, 0}, 0.5).distance == 4);
  CHECK(!ray_point(ray, {4, 0.51, 0}, 0.5));
  CHECK(!ray_point(ray, {-1, 0, 0}, 0.5));
}

}  // namespace test_ray_hits
