// SPDX-License-Identifier: BSL-1.0
// A ball that carves its way through a block.
#include "carved_block.hpp"

namespace test_carving {

using namespace carving;

TEST_CASE("a ball moves through a block, and takes out what it touches", "[long]") {
  for (const bool surfaceCollides : {false, true}) {
    const Block block(4, 3);
    auto sim = scene(block, {0.05, 0.2, 0.5}, surfaceCollides);
    sim.init();
    check_whole(sim);
    auto& carving = sim.root().get<CarvingManager>();
    std::size_t left = block.tetrahedra.size();
    int carvedSteps = 0;
    for (int step = 0; step < 150; ++step) {
      auto& tool = sim.at<"tool">().state().position[0];
      // down to where it lies a radius deep, and through
      if (step < 50)
        tool[2] = 0.5 - 0.005 * step;
      else
        tool[0] = 0.05 + 0.004 * (step - 50);
      sim.animate(0.01);
      const std::size_t now = sim.at<"block">().get<TetrahedronTopology>().tetrahedra.size();
      REQUIRE(now <= left);
      REQUIRE(std::size_t(carving.removed) == block.tetrahedra.size() - now);
      if (now == left) continue;
      ++carvedSteps;
      left = now;
      check_whole(sim);
      check_as_fresh(sim, surfaceCollides);
    }
    CHECK(carvedSteps > 10);
    CHECK(left < block.tetrahedra.size() - 60);
    CHECK(left > 60);
    CHECK(carving.message.empty());
  }
}

TEST_CASE("only what is nearer than the carving distance goes, and nothing while it is not active") {
  const Block block(2, 2);
  const double height = 0.2 + 0.1;  // of the ball when it touches
  auto count = [&](double gap, bool active, std::optional<double> distance) {
    auto sim = scene(block, {0.1, 0.1, height + gap}, false, active, distance);
    sim.init();
    sim.animate(1e-6);
    return sim.root().get<CarvingManager>().removed;
  };
  CHECK(count(0.06, true, {}) == 0);  // from the contact distance on, 0.05 m
  CHECK(count(0.04, true, {}) > 0);
  CHECK(count(0.04, false, {}) == 0);
  CHECK(count(0.04, true, 0.03) == 0);
  CHECK(count(0.02, true, 0.03) > 0);
  CHECK(count(0.02, true, -0.01) == 0);
  CHECK(count(-0.02, true, -0.01) > 0);
}

TEST_CASE("a removal leaves a hole under the ball: the tetrahedron of the touched triangle goes") {
  const Block block(2, 2);
  auto sim = scene(block, {0.13, 0.14, 0.34}, false);
  sim.init();
  sim.animate(1e-6);
  auto const& before = block.tetrahedra;
  auto const& after = sim.at<"block">().get<TetrahedronTopology>().tetrahedra;
  REQUIRE(after.size() == before.size() - 1);
  // the one with a face in the top, over whose inside the ball is
  for (std::size_t e = 0; e < before.size(); ++e) {
    if (e < after.size() && after[e] == before[e]) continue;
    Point low(1, 1, 1), high(0, 0, 0);
    int top = 0;
    for (const int i : before[e]) {
      Point const& p = block.points[std::size_t(i)];
      if (p[2] < 0.2 - 1e-9) continue;
      ++top;
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
    CHECK(top == 3);
    CHECK((low - Point(0.1, 0.1, 0.2)).norm() < 1e-12);
    CHECK((high - Point(0.2, 0.2, 0.2)).norm() < 1e-12);
    break;
  }
}

TEST_CASE("the last element stays, and says so") {
  Block block(1, 1);
  auto sim = scene(block, {0.05, 0.05, 0.15}, false);
  sim.init();
  for (int step = 0; step < 400; ++step) {
    // to and fro through all of it
    sim.at<"tool">().state().position[0] =
        Point(0.05 + 0.05 * std::sin(0.3 * step), 0.05 + 0.05 * std::cos(0.4 * step), 0.15 - 0.0005 * step);
    sim.animate(0.001);
  }
  CHECK(sim.at<"block">().get<TetrahedronTopology>().tetrahedra.size() == 1);
  CHECK(sim.root().get<CarvingManager>().message.find("/root/block") != std::string::npos);
  check_whole(sim);
}

TEST_CASE("what is held goes on to be held, unless it is removed") {
  const Block block(4, 2);
  auto sim = scene(block, {0.05, -1, 0.5}, false);
  sim.init();
  const int here = sim.attach(*sim.pick({0.1, 0.12, 1}, {0, 0, -1}), {.stiffness = 100}),
            there = sim.attach(*sim.pick({0.37, 0.36, 1}, {0, 0, -1}), {.stiffness = 100});
  sim.animate(0.001);
  const Point held = sim.attachment(there)->target;
  for (int step = 0; step < 200 && sim.attachment(here); ++step) {
    sim.at<"tool">().state().position[0] =
        Point(0.1 + 0.05 * std::sin(0.3 * step), 0.1 + 0.05 * std::cos(0.4 * step), 0.4 - 0.002 * step);
    sim.animate(0.001);
    check_whole(sim);
  }
  CHECK(!sim.attachment(here));
  CHECK(!sim.pull(here, {0, 0, 0}));
  REQUIRE(sim.attachment(there));
  sim.pull(there, held + Point(0, 0, 0.05));
  for (int i = 0; i < 3; ++i) sim.animate(0.001);
  CHECK(sim.attachment(there)->contact.force[2] > 1);
}

TEST_CASE("a carving manager without a tool, or without something to carve, is refused") {
  const Block block(1, 1);
  auto message = [&](auto change) {
    auto sim = scene(block, {0, 0, 1}, false);
    change(sim);
    try {
      sim.init();
    } catch (Error const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  auto has = [](std::string const& m, std::string_view words) { return m.find(words) != m.npos; };
  CHECK(message([](auto&) {}).empty());
  CHECK(has(message([](auto& sim) { sim.root().template get<CarvingManager>().toolModel = ""; }),
            "toolModel is not given"));
  const auto m = message([](auto& sim) { sim.root().template get<CarvingManager>().toolModel = "knife"; });
  CHECK(has(m, "/root/knife"));
  CHECK(has(m, "/root/tool"));
  CHECK(has(message([](auto& sim) { sim.root().template get<CarvingManager>().surfaceModelPath = "tool"; }),
            "nothing to carve"));
  CHECK(has(message([](auto& sim) { sim.root().template get<CarvingManager>().carvingDistance = 0.5; }),
            "raise the alarm distance"));
  CHECK(message([](auto& sim) {
          auto& c = sim.root().template get<CarvingManager>();
          c.toolModel = "@/tool", c.surfaceModelPath = "./block/../block";
        }).empty());
}

}  // namespace test_carving
