// SPDX-License-Identifier: BSL-1.0
// Thousands of removals at random, by a ball that goes about and by number, in blocks that are held and
// touched: nothing refers to what has gone, and what is left is as built afresh.
#include "carved_block.hpp"

namespace test_carving_random {

using namespace carving;

TEST_CASE("after hundreds of removals at random nothing refers to what has gone") {
  std::mt19937 random(11);
  auto number = [&](std::size_t n) { return Index(random() % n); };
  auto within = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  long removals = 0, removed = 0, carved = 0, compared = 0, dropped = 0, kept = 0;
  for (int round = 0; removals < 600; ++round) {
    const Block block(2 + round % 2, 2);
    const bool surfaceCollides = round % 3 == 0;
    auto sim = scene(block, {0.1, 0.1, 1}, surfaceCollides);
    sim.init();
    auto& tetrahedra = sim.at<"block">().get<TetrahedronTopology>().tetrahedra;
    std::vector<int> held;
    for (int step = 0; tetrahedra.size() > 6; ++step) {
      sim.at<"tool">().state().position[0] =
          Point(within(0, 0.3), within(0, 0.3), within(0.25, 0.4) - 0.001 * step);
      const std::size_t before = tetrahedra.size();
      sim.animate(0.002);
      if (tetrahedra.size() != before) ++removals, carved += long(before - tetrahedra.size());
      removed += long(before - tetrahedra.size());
      if (const auto hit = sim.pick({within(0, 0.3), within(0, 0.3), 2}, {0, 0, -1}); hit && hit->simulated)
        held.push_back(sim.attach(*hit, {.stiffness = 5}));
      if (tetrahedra.size() > 6) {
        ElementNumbers gone{.tetrahedra = {number(tetrahedra.size())}};
        if (step % 2) gone.tetrahedra.push_back(number(tetrahedra.size()));
        removed += 1 + (gone.tetrahedra.size() == 2 && gone.tetrahedra[0] != gone.tetrahedra[1]);
        const auto change = sim.removeElements("block", gone);
        ++removals;
        REQUIRE(change.of(ElementKind::tetrahedron).kept.size() == tetrahedra.size());
      }
      for (const int id : held) (sim.attachment(id) ? kept : dropped) += 1;
      std::erase_if(held, [&](int id) { return !sim.attachment(id); });
      check_whole(sim);
      if (step % 5 == 0) {
        for (const int id : held) sim.release(id);
        held.clear();
        check_as_fresh(sim, surfaceCollides);
        ++compared;
      }
    }
  }
  CHECK(removed > 900);
  CHECK(carved > 100);
  CHECK(compared > 40);
  CHECK(dropped > 10);
  CHECK(kept > 100);
}

}  // namespace test_carving_random
