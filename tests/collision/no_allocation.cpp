// SPDX-License-Identifier: BSL-1.0
// Counts what the search structures allocate.
#include <sinew/collision/broad_phase.hpp>

#include "catch.hpp"
#include "collision/allocations.hpp"
#include "collision/moving_things.hpp"

namespace test_no_allocation {

using namespace sinew;
using namespace moving;

TEST_CASE("after the first build a tree does not allocate, built anew or not") {
  Balls balls(600, 8, 1);
  BoundingTree tree;
  long before = allocations;
  tree.build(balls.boxes());
  CHECK(allocations > before);
  int built = 0, pairs = 0;
  for (int step = 0; step < 200; ++step) {
    balls.move(0.05);
    const auto boxes = balls.boxes();
    before = allocations;
    built += tree.update(boxes);
    tree.self_pairs(0, [&](int, int) { ++pairs; });
    tree.pairs(tree, 0, [&](int, int) { ++pairs; });
    tree.near(boxes[0], 0, [&](int) { ++pairs; });
    tree.ray({0, 0, 0}, {1, 1, 1}, 10, [&](int, double end) { return ++pairs, end; });
    tree.nearest(Point(1, 2, 3), 10, [&](int i) { return boxes[std::size_t(i)].distance(boxes[0]) + 10; });
    // fewer, of another kind
    if (step % 50 == 49) tree.build(std::span(boxes).first(100)), tree.build(std::vector<AxisBox>{});
    if (step % 50 == 49) tree.build(boxes);
    CHECK(allocations == before);
  }
  CHECK(built > 3);
  CHECK(pairs > 1000);
}

TEST_CASE("a broad phase allocates for more pairs than ever, and then no more") {
  Balls balls(600, 8, 1);
  BroadPhase phase;
  // the most pairs there can be
  const std::vector<AxisBox> same(600, AxisBox{{0, 0, 0}, {1, 1, 1}});
  CHECK(phase.pairs(same, 0).size() == 600 * 599 / 2);
  for (int step = 0; step < 100; ++step) {
    balls.move(0.05);
    const auto boxes = balls.boxes();
    const long before = allocations;
    const std::size_t found = phase.pairs(boxes, 0).size();
    CHECK(allocations == before);
    CHECK(found > 10);
  }
}

}  // namespace test_no_allocation
