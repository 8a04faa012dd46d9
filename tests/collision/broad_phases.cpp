// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/tree_broad_phase.hpp>

#include <random>
#include <set>

#include "catch.hpp"

namespace test_broad_phases {

using namespace sinew;

TEST_CASE("the broad phases find the same pairs of moving models") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 5), step(-0.2, 0.2), size(0, 1);
  std::vector<CollisionSurface> models(200);
  std::vector<CollisionSurface*> surfaces;
  for (auto& m : models) {
    const Eigen::Vector3d p(place(random), place(random), place(random));
    m.box.include(p);
    m.box.include(p + Eigen::Vector3d(size(random), size(random), size(random)));
    surfaces.push_back(&m);
  }
  models[7].box = AxisBox{};  // one without primitives
  BruteForceBroadPhase all;
  TreeBroadPhase tree;
  auto found = [&](auto& phase) {
    std::set<std::pair<int, int>> pairs;
    std::size_t calls = 0;
    phase.pairs(surfaces, [&](int i, int j) {
      CHECK(i <= j);
      pairs.insert({i, j});
      ++calls;
    });
    CHECK(calls == pairs.size());  // none twice
    return pairs;
  };
  for (int n = 0; n < 50; ++n) {
    const auto pairs = found(all);
    CHECK(found(tree) == pairs);
    CHECK(pairs.contains({3, 3}));  // a model and itself
    CHECK(!pairs.contains({7, 7}));
    CHECK(pairs.size() > 250);
    for (std::size_t i = 0; i < models.size(); ++i) {
      if (i == 7) continue;
      const Eigen::Vector3d d(step(random), step(random), step(random));
      models[i].box.min += d;
      models[i].box.max += d;
    }
  }
}

}  // namespace test_broad_phases
