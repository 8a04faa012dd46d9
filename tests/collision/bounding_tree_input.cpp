// SPDX-License-Identifier: BSL-1.0
// Few, equal, absent and senseless boxes.
#include <sinew/collision/bounding_tree.hpp>

#include "catch.hpp"
#include "collision/moving_things.hpp"
#include "error_of.hpp"

namespace test_bounding_tree_input {

using namespace sinew;
using namespace moving;
using Catch::Matchers::Contains;

namespace {

const double inf = std::numeric_limits<double>::infinity(),
             notANumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("trees of no, one and two primitives") {
  const AxisBox box{{0, 0, 0}, {1, 1, 1}};
  BoundingTree none, one, two;
  CHECK(none.update({}) == false);
  none.build({});
  one.build(std::vector{box});
  two.build(std::vector{box, box.grown(1)});
  CHECK(none.size() == 0);
  CHECK(none.bounds().empty());
  CHECK(none.degradation() == 1);
  none.refit({});
  CHECK(reported_self(none, 1).empty());
  CHECK(reported(none, two, 1).empty());
  CHECK(reported(two, none, 1).empty());
  CHECK(none.nearest(Point(0, 0, 0), 1, [](int) { return 0.0; }).index == -1);
  CHECK(none.ray({0, 0, 0}, {1, 0, 0}, 1, [](int, double) { return 0.0; }) == 1);
  CHECK(reported_self(one, 1).empty());
  CHECK(one.bounds() == box);
  CHECK(reported_self(two, 0) == std::vector<BoxPair>{{0, 1}});
  CHECK(reported(one, two, 0) == std::vector<BoxPair>{{0, 0}, {0, 1}});
  CHECK(reported(two, one, 0) == std::vector<BoxPair>{{0, 0}, {1, 0}});
}

TEST_CASE("boxes in one place, and points") {
  for (const auto& box : {AxisBox{{0, 0, 0}, {1, 1, 1}}, AxisBox{{3, 3, 3}, {3, 3, 3}}}) {
    const std::vector<AxisBox> boxes(100, box);
    BoundingTree tree;
    tree.build(boxes);
    CHECK(reported_self(tree, 0).size() == 99 * 100 / 2);
    CHECK(sorted(reported_self(tree, 0)) == all_pairs(boxes, 0.0));
    CHECK(reported(tree, tree, 0).size() == 100 * 100);
    tree.refit(boxes);
    CHECK(tree.degradation() == 1);
  }
}

// each is 4 times as far as the one before: as uneven as numbers allow, and areas overflow
TEST_CASE("places as far apart as numbers go") {
  std::vector<AxisBox> boxes;
  for (int i = -500; i <= 500; ++i) {
    const double x = std::ldexp(1.0, 2 * i);
    boxes.push_back({{x, x, x}, {1.5 * x, 1.5 * x, 1.5 * x}});
    boxes.push_back({{1.25 * x, x, x}, {2 * x, 2 * x, 2 * x}});
  }
  BoundingTree tree;
  tree.build(boxes);
  CHECK(sorted(reported_self(tree, 0)) == all_pairs(boxes, 0.0));
  CHECK(reported_self(tree, 0).size() == 1001);
  CHECK_FALSE(tree.update(boxes));
  const auto nearest = tree.nearest(Point(0, 0, 0), inf, [&](int i) {
    return boxes[std::size_t(i)].distance({{0, 0, 0}, {0, 0, 0}});
  });
  CHECK(nearest.index >= 0);
}

TEST_CASE("absent primitives are not reported, and may come back") {
  Balls balls(200, 5, 9);
  for (const std::size_t present : {0u, 1u, 50u, 199u}) {
    auto boxes = balls.boxes();
    const auto all = boxes;
    std::mt19937 random(4);
    for (std::size_t left = boxes.size(); left > present;)
      if (auto& b = boxes[random() % boxes.size()]; !b.empty())
        b = left % 2 ? AxisBox{} : AxisBox{{0, 1, 0}, {1, 0, 1}}, --left;
    BoundingTree tree;
    tree.build(boxes);
    CHECK(sorted(reported_self(tree, 0.1)) == all_pairs(boxes, 0.1));
    int count = 0;
    if (present) tree.near(tree.bounds(), 0, [&](int i) { count += !boxes[std::size_t(i)].empty(); });
    CHECK(count == int(present));
    tree.ray({-1, 2, 2}, {1, 0.1, 0.1}, inf, [&](int i, double end) {
      CHECK_FALSE(boxes[std::size_t(i)].empty());
      return end;
    });
    tree.nearest(Point(2, 2, 2), inf, [&](int i) {
      CHECK_FALSE(boxes[std::size_t(i)].empty());
      return boxes[std::size_t(i)].distance({{2, 2, 2}, {2, 2, 2}});
    });

    tree.refit(all);
    CHECK(sorted(reported_self(tree, 0.1)) == all_pairs(all, 0.1));
    tree.refit(boxes);
    CHECK(sorted(reported_self(tree, 0.1)) == all_pairs(boxes, 0.1));
  }
}

TEST_CASE("what is not finite is an error, and the tree stays") {
  Balls balls(50, 3, 2);
  auto boxes = balls.boxes();
  BoundingTree tree;
  tree.build(boxes);
  const auto before = reported_self(tree, 0);
  for (const double wrong : {notANumber, inf, -inf})
    for (const bool low : {false, true})
      for (int c = 0; c < 3; ++c) {
        // an infinity on the wrong side makes an empty box
        if (wrong == (low ? inf : -inf)) continue;
        auto bad = boxes;
        (low ? bad[17].min : bad[17].max)[c] = wrong;
        CHECK_THAT(error_of([&] { tree.refit(bad, "root/skin: Pipeline"); }),
                   Contains("root/skin: Pipeline: box 17 reaches from (") && Contains("not finite") &&
                       Contains("empty box"));
        CHECK_THAT(error_of([&] { tree.build(bad); }), Contains("BoundingTree: box 17 "));
        CHECK_THAT(error_of([&] { tree.update(bad); }), Contains("box 17 "));
        CHECK(tree.size() == 50);
        CHECK(reported_self(tree, 0) == before);
      }
  CHECK_THAT(error_of([&] { tree.refit(std::span(boxes).first(49)); }),
             Contains("refit got 49 boxes, but the tree was built for 50; build it anew"));
  CHECK(reported_self(tree, 0) == before);
}

}  // namespace test_bounding_tree_input
