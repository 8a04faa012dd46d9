// SPDX-License-Identifier: BSL-1.0
// Rays and nearest primitives, against asking all.
#include <sinew/collision/bounding_tree.hpp>

#include "catch.hpp"
#include "collision/moving_things.hpp"

#include <optional>

namespace test_bounding_tree_search {

using namespace sinew;
using namespace moving;

namespace {

const double inf = std::numeric_limits<double>::infinity();

// t where a ray enters a ball
std::optional<double> meets(Balls const& balls, int i, Point const& origin, Point const& direction) {
  const Point to = balls.centers[std::size_t(i)] - origin;
  const double r = balls.radii[std::size_t(i)], a = direction.squaredNorm(), b = direction.dot(to);
  const double root = b * b - a * (to.squaredNorm() - r * r);
  if (root < 0) return {};
  const double t = (b - std::sqrt(root)) / a;
  if (t < 0) return {};
  return t;
}

}  // namespace

TEST_CASE("a ray meets the first ball") {
  Balls balls(500, 10, 1), rays(300, 10, 2);
  BoundingTree tree;
  tree.build(balls.boxes());
  int met = 0;
  long asked = 0;
  for (int step = 0; step < 20; ++step) {
    balls.move(0.05);
    tree.refit(balls.boxes());
    for (std::size_t k = 0; k < rays.centers.size(); ++k) {
      const Point origin = rays.centers[k];
      Point direction = rays.velocities[k];
      if (k % 5 == 0) direction[int(k / 5 % 3)] = 0;
      const double reach = k % 2 ? inf : 3.0;
      double expected = reach;
      int ball = -1, found = -1;
      for (int i = 0; i < 500; ++i)
        if (auto t = meets(balls, i, origin, direction); t && *t < expected) expected = *t, ball = i;
      const double end = tree.ray(origin, direction, reach, [&](int i, double so_far) {
        ++asked;
        const auto t = meets(balls, i, origin, direction);
        if (!t || !(*t < so_far)) return so_far;
        found = i;
        return *t;
      });
      REQUIRE(end == expected);
      REQUIRE(found == ball);
      met += ball >= 0;
    }
  }
  CHECK(met > 1000);
  // what lies behind a hit is not asked
  CHECK(asked < 4000);  // of 6000 rays; 4224 with the far child first
}

TEST_CASE("a ray reports all boxes that it enters, and stops when told") {
  Sheet sheet(12, 0, 0);
  const auto boxes = sheet.boxes();
  BoundingTree tree;
  tree.build(boxes);
  Balls rays(200, 1, 2);
  std::size_t all = 0;
  for (std::size_t k = 0; k < rays.centers.size(); ++k) {
    const Point origin = rays.centers[k] - Point(0, 0, 0.5), direction = rays.velocities[k];
    std::vector<int> found, expected;
    tree.ray(origin, direction, 2, [&](int i, double end) { return found.push_back(i), end; });
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (boxes[i].rayEntry(origin, direction, 2) <= 2) expected.push_back(int(i));
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
    all += found.size();
    int asked = 0;
    tree.ray(origin, direction, 2, [&](int, double) { return ++asked, -1.0; });
    CHECK(asked == std::min(1, int(expected.size())));
  }
  CHECK(all > 150);
}

TEST_CASE("the nearest ball to a point, over 50 steps") {
  Balls balls(400, 8, 1), places(50, 12, 2);
  BoundingTree tree;
  tree.build(balls.boxes());
  long asked = 0;
  int none = 0;
  for (int step = 0; step < 50; ++step) {
    balls.move(0.05);
    tree.refit(balls.boxes());
    for (Point const& place : places.centers) {
      auto distance = [&](int i) {
        return std::max((balls.centers[std::size_t(i)] - place).norm() - balls.radii[std::size_t(i)], 0.0);
      };
      const double reach = step % 2 ? inf : 0.3;
      BoundingTree::Nearest expected;
      for (int i = 0; i < 400; ++i)
        if (const double d = distance(i); d <= reach && d < expected.distance) expected = {i, d};
      const auto found = tree.nearest(place, reach, [&](int i) { return ++asked, distance(i); });
      REQUIRE(found.index == expected.index);
      REQUIRE(found.distance == expected.distance);
      none += found.index < 0;
    }
  }
  CHECK(none > 100);
  CHECK(asked < 5 * 50 * 50);
}

TEST_CASE("of several at one distance the first is the nearest") {
  // on a grid, and asked from its cells' middles: eight at one distance
  std::vector<AxisBox> boxes;
  for (int i = 0; i < 216; ++i) {
    const Point p(i % 6, i / 6 % 6, i / 36);
    boxes.push_back({p, p});
  }
  BoundingTree tree;
  tree.build(boxes);
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) {
        const Point place(x + 0.5, y + 0.5, z + 0.5);
        const auto found =
            tree.nearest(place, inf, [&](int i) { return (boxes[std::size_t(i)].min - place).norm(); });
        REQUIRE(found.index == x + 6 * y + 36 * z);
        REQUIRE(found.distance == Approx(std::sqrt(0.75)));
      }
}

TEST_CASE("the nearest to a box") {
  Balls balls(300, 8, 1), others(40, 12, 2);
  const auto boxes = balls.boxes();
  BoundingTree tree;
  tree.build(boxes);
  for (auto const& box : others.boxes()) {
    BoundingTree::Nearest expected;
    for (int i = 0; i < 300; ++i)
      if (const double d = boxes[std::size_t(i)].distance(box); d < expected.distance) expected = {i, d};
    const auto found = tree.nearest(box, inf, [&](int i) { return boxes[std::size_t(i)].distance(box); });
    REQUIRE(found.index == expected.index);
    REQUIRE(found.distance == expected.distance);
  }
}

}  // namespace test_bounding_tree_search
