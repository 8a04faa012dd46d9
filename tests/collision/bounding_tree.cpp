// SPDX-License-Identifier: BSL-1.0
// Which pairs a tree reports, against comparing all with all.
#include <sinew/collision/bounding_tree.hpp>

#include "catch.hpp"
#include "collision/moving_things.hpp"

namespace test_bounding_tree {

using namespace sinew;
using namespace moving;

TEST_CASE("pairs of two sheets that deform, over 300 steps: none missed, none twice") {
  Sheet upper(12, 0.1, 1), lower(9, 0, 0);
  BoundingTree a, b;
  a.build(upper.boxes());
  b.build(lower.boxes());
  std::size_t all = 0;
  for (int step = 0; step < 300; ++step) {
    upper.move(0.02 * step), lower.move(-0.03 * step);
    const auto boxesA = upper.boxes(), boxesB = lower.boxes();
    a.refit(boxesA);
    b.refit(boxesB);
    const double margin = 0.01 * (step % 4 - 1);
    const auto expected = all_pairs_between(boxesA, boxesB, margin);
    REQUIRE(sorted(reported(a, b, margin)) == expected);
    all += expected.size();
    // the larger tree may be either
    if (step % 10 == 0) {
      auto mirrored = all_pairs_between(boxesB, boxesA, margin);
      REQUIRE(sorted(reported(b, a, margin)) == mirrored);
    }
  }
  CHECK(all > 100 * 300);
}

TEST_CASE("pairs within a sheet that deforms, over 200 steps: none missed, none twice, i < j") {
  Sheet sheet(11, 0, 0);
  BoundingTree tree;
  tree.build(sheet.boxes());
  for (int step = 0; step < 200; ++step) {
    sheet.move(0.05 * step);
    const auto boxes = sheet.boxes();
    tree.refit(boxes);
    REQUIRE(sorted(reported_self(tree, 0.01)) == all_pairs(boxes, 0.01));
  }
}

TEST_CASE("the boxes of all levels of a tree are in those above, and all primitives in those of each") {
  Balls balls(400, 8, 3);
  const auto boxes = balls.boxes();
  BoundingTree tree;
  tree.each_box([](auto const&, int) { FAIL("there is none"); });
  tree.build(boxes);
  std::vector<AxisBox> around;  // of the levels above
  std::size_t count = 0, halves = 0;
  tree.each_box([&](AxisBox const& box, int level) {
    REQUIRE(std::size_t(level) <= around.size());
    around.resize(std::size_t(level));
    if (level > 0) {
      CHECK((around.back().min.array() <= box.min.array()).all());
      CHECK((around.back().max.array() >= box.max.array()).all());
    }
    around.push_back(box);
    ++count;
    halves += level == 1;
  });
  CHECK(halves == 2);
  CHECK(count % 2 == 1);  // each inner box has two in it
  CHECK(count >= 2 * 400 / 12 - 1);
  CHECK(around.front().min == tree.bounds().min);
  CHECK(around.front().max == tree.bounds().max);
}

TEST_CASE("a tree refitted for balls that fly far degrades, and is built anew") {
  Balls balls(400, 8, 3);
  BoundingTree tree;
  CHECK(tree.update(balls.boxes()));
  CHECK(tree.degradation() == 1);
  BoundingTree only;
  only.build(balls.boxes());
  int built = 0;
  for (int step = 0; step < 300; ++step) {
    balls.move(0.05);
    const auto boxes = balls.boxes();
    const bool anew = tree.update(boxes);
    only.refit(boxes);
    built += anew;
    CHECK(tree.degradation() <= tree.rebuildFactor);
    if (anew) CHECK(tree.degradation() == 1);
    const auto expected = all_pairs(boxes, 0.0);
    REQUIRE(sorted(reported_self(tree, 0)) == expected);
    REQUIRE(sorted(reported_self(only, 0)) == expected);
  }
  // the balls cross the cube twice
  CHECK(built >= 5);
  CHECK(built <= 100);
  CHECK(only.degradation() > 3);

  // what moves as a whole or grows does not degrade
  auto boxes = balls.boxes();
  tree.build(boxes);
  for (auto& b : boxes) b = {b.min * 16 + Point(1, 2, 3), b.max * 16 + Point(1, 2, 3)};
  CHECK_FALSE(tree.update(boxes));
  CHECK(tree.degradation() == Approx(1));
}

TEST_CASE("primitives near a box") {
  Balls balls(300, 6, 5);
  const auto boxes = balls.boxes();
  BoundingTree tree;
  tree.build(boxes);
  Balls places(100, 6, 6);
  std::size_t all = 0;
  for (auto const& box : places.boxes())
    for (const double margin : {0.0, 0.5, -0.1}) {
      std::vector<int> found, expected;
      tree.near(box, margin, [&](int i) { found.push_back(i); });
      for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].overlaps(box, margin)) expected.push_back(int(i));
      std::sort(found.begin(), found.end());
      REQUIRE(found == expected);
      all += found.size();
    }
  CHECK(all > 100);
  int count = 0;
  tree.near(tree.bounds(), 0, [&](int) { ++count; });
  CHECK(count == 300);
  tree.near({}, 1e9, [&](int) { ++count; });
  CHECK(count == 300);
}

TEST_CASE("the same boxes give the same answers in the same order, whatever came before") {
  Balls balls(500, 7, 7);
  const auto start = balls.boxes();
  for (int step = 0; step < 100; ++step) balls.move(0.1);
  const auto end = balls.boxes();
  BoundingTree first, second;
  first.build(end);
  second.build(start);
  second.build(std::vector<AxisBox>(3, start[0]));
  second.refit(std::vector<AxisBox>(3, start[1]));
  second.build(end);
  CHECK(reported_self(first, 0.1) == reported_self(second, 0.1));
  CHECK_FALSE(reported_self(first, 0.1).empty());
  CHECK(reported(first, second, 0) == reported(second, first, 0));
  const BoundingTree copy = first;
  CHECK(reported_self(copy, 0.1) == reported_self(first, 0.1));
}

TEST_CASE("trees in single precision") {
  Balls balls(300, 6, 5);
  std::vector<BasicAxisBox<float>> boxes;
  for (auto const& b : balls.boxes()) boxes.push_back({b.min.cast<float>(), b.max.cast<float>()});
  BasicBoundingTree<float> tree;
  tree.build(boxes);
  std::vector<BoxPair> found;
  tree.self_pairs(0.01f, [&](int i, int j) { found.push_back({i, j}); });
  CHECK(sorted(found) == all_pairs(boxes, 0.01f));
  CHECK(found.size() > 100);
}

}  // namespace test_bounding_tree
