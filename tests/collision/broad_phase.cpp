// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/broad_phase.hpp>

#include "catch.hpp"
#include "collision/moving_things.hpp"

namespace test_broad_phase {

using namespace sinew;
using namespace moving;

namespace {

std::vector<BoxPair> pairs_of(BroadPhase& phase, std::vector<AxisBox> const& boxes, double margin) {
  const auto pairs = phase.pairs(boxes, margin);
  return {pairs.begin(), pairs.end()};
}

}  // namespace

TEST_CASE("balls that fly, 300 steps: the pairs of comparing all, sorted") {
  Balls balls(300, 6, 1);
  BroadPhase phase;
  std::size_t all = 0;
  for (int step = 0; step < 300; ++step) {
    balls.move(0.03);
    const auto boxes = balls.boxes();
    const auto found = pairs_of(phase, boxes, 0.02);
    REQUIRE(found == all_pairs(boxes, 0.02));
    all += found.size();
  }
  CHECK(all > 300 * 100);
}

TEST_CASE("bodies that come, go and jump, and one as large as all") {
  std::mt19937 random(8);
  Balls balls(200, 5, 1);
  auto boxes = balls.boxes();
  boxes.push_back({{-1, -1, -1}, {6, 6, 0.1}});
  BroadPhase phase;
  for (int step = 0; step < 200; ++step) {
    const auto at = [&] { return std::size_t(random() % (boxes.size() - 1)); };
    auto& jumping = boxes[at()];
    const Point by(double(random() % 100) - 50, 0, double(random() % 3) - 1);
    if (!jumping.empty()) jumping = {jumping.min + by, jumping.max + by};
    boxes[at()] = AxisBox{};                                                  // leaves its place
    boxes[at()] = balls.boxes()[std::size_t(step) % balls.centers.size()];    // is there again
    if (step % 7 == 0) boxes.erase(boxes.begin() + long(at()));               // is no more
    if (step % 5 == 0) boxes.insert(boxes.begin(), boxes[at()].grown(0.01));  // is new
    REQUIRE(pairs_of(phase, boxes, 0) == all_pairs(boxes, 0.0));
  }
}

TEST_CASE("no bodies, one, all in one place") {
  BroadPhase phase;
  CHECK(phase.pairs({}, 1).empty());
  CHECK(pairs_of(phase, {AxisBox{{0, 0, 0}, {1, 1, 1}}}, 1).empty());
  const std::vector<AxisBox> same(60, AxisBox{{0, 0, 0}, {1, 1, 1}});
  CHECK(pairs_of(phase, same, 0) == all_pairs(same, 0.0));
  CHECK(pairs_of(phase, same, 0).size() == 60 * 59 / 2);
  CHECK(phase.pairs(std::vector<AxisBox>(5), 1).empty());
}

TEST_CASE("the pairs do not depend on what came before") {
  Balls balls(300, 6, 1);
  BroadPhase moved;
  for (int step = 0; step < 100; ++step) {
    balls.move(0.1);
    moved.pairs(balls.boxes(), 0);
  }
  BroadPhase fresh;
  CHECK(pairs_of(moved, balls.boxes(), 0) == pairs_of(fresh, balls.boxes(), 0));
}

TEST_CASE("a body that is nowhere is an error with the place of the caller") {
  BroadPhase phase;
  std::vector<AxisBox> boxes(3, AxisBox{{0, 0, 0}, {1, 1, 1}});
  boxes[2].max[1] = std::nan("");
  CHECK_THROWS_WITH(phase.pairs(boxes, 0, "root: BruteForceBroadPhase"),
                    Catch::Matchers::Contains("root: BruteForceBroadPhase: box 2 reaches from"));
  boxes[2].max[1] = 1;
  CHECK(phase.pairs(boxes, 0).size() == 3);
}

TEST_CASE("pairs are sorted, few and many") {
  std::mt19937 random(3);
  PairSorter sorter;
  for (const std::size_t n : {0u, 1u, 10u, 1000u, 20000u}) {
    std::vector<BoxPair> pairs;
    for (std::size_t k = 0; k < n; ++k) pairs.push_back({int(random() % 300), int(random() % 1000)});
    const auto expected = sorted(pairs);
    sorter.sort(pairs, 300, 1000);
    CHECK(pairs == expected);
  }
}

}  // namespace test_broad_phase
