// SPDX-License-Identifier: BSL-1.0
// Blades through blocks of tetrahedra: what is parted, and what stays. cut() checks volume, quality and skin.
#include "cut_bodies.hpp"

namespace test_cut_plan {

using namespace cutting;

TEST_CASE("a cut along the faces of a mesh makes no elements, and one between them parts them") {
  Body b = block(4, 2, 2);
  const CutPlan along = cut(b, Plane{2}.blade(-1, 3, -1, 3));
  CHECK(b.tetrahedra.size() == 96);
  CHECK(b.points.size() == 45 + 9);
  CHECK(along.faces == 8);
  CHECK(pieces(b) == 2);
  CHECK(along.front.points.empty());
  CHECK(along.front.crossings.empty());

  b = block(4, 2, 2);
  const CutPlan between = cut(b, Plane{2.4}.blade(-1, 3, -1, 3));
  CHECK(b.tetrahedra.size() > 96);
  CHECK(pieces(b) == 2);
  CHECK(between.ofTopology[0].of(ElementKind::tetrahedron).size() == b.tetrahedra.size());
  // without snapping all crossings are where the blade is
  b = block(4, 2, 2);
  cut(b, Plane{2.1}.blade(-1, 3, -1, 3), {.snapping = 0, .quality = 0});
  CHECK(pieces(b) == 2);
  for (auto const& e : b.tetrahedra) {
    double low = 9, high = -9;
    for (const Index i : e) {
      low = std::min(low, b.points[std::size_t(i)][0]);
      high = std::max(high, b.points[std::size_t(i)][0]);
    }
    CHECK((low > 2.1 - 1e-9 || high < 2.1 + 1e-9));
  }
}

TEST_CASE("a blade that misses, or ends within elements, parts nothing") {
  Body b = block(2, 2, 2);
  CHECK(!cut(b, Plane{3}.blade(-1, 3, -1, 3)).changes());
  CHECK(!cut(b, Plane{1.3}.blade(0.1, 0.3, 0.1, 0.3)).changes());
  CHECK(!cut(b, {{Point(1, -1, 1), Point(1, 3, 1)}, {Point(1, -1, 1), Point(1, 3, 1)}}).changes());
}

TEST_CASE("a partial cut, one that completes it, and one that crosses both") {
  Body b = block(6, 4, 4, 0.2);
  cut(b, Plane{3.1}.blade(-1, 3.1, 2.2, 5));
  CHECK(pieces(b) == 1);
  CHECK(b.points.size() > 175);
  cut(b, Plane{3.1}.blade(-1, 5, -1, 5));
  CHECK(pieces(b) == 2);
  cut(b, {{Point(-1, 2.3, -1), Point(-1, 2.3, 5)}, {Point(7, 2.3, -1), Point(7, 2.3, 5)}});
  CHECK(pieces(b) == 4);
}

TEST_CASE("a plane cut in steps parts the block as one that is cut at once") {
  for (int seed = 0; seed < (brief ? 15 : 60); ++seed) {
    std::mt19937 random{unsigned(seed)};
    std::uniform_real_distribution<double> u(-1, 1);
    Body b = block(6, 4, 4, 0.125 * (seed % 3));
    const Plane plane{3.1 + 0.3 * u(random), 0.2 * u(random), 0.2 * u(random)};
    CutFront front;
    const int steps = 5 + 2 * (seed % 24);
    for (int i = 0; i < steps; ++i)
      front = cut(b,
                  BladeStroke{SweptBlade("blade",
                                         plane.blade(-1 + 6. * i / steps, -1 + 6. * (i + 1) / steps, -1, 5))},
                  front)
                  .front;
    CHECK(pieces(b) == 2);
  }
}

TEST_CASE("random cuts, one after the other") {
  for (int seed = 0; seed < (brief ? 40 : 150); ++seed) {
    std::mt19937 random{unsigned(seed)};
    std::uniform_real_distribution<double> u(-1, 5);
    auto point = [&] { return Point(u(random), u(random), u(random)); };
    Body b = block(4, 3, 3, seed % 2 ? 0.2 : 0);
    for (int c = 0; c < 4; ++c) {
      const Blade blade{{point(), point()}, {point(), point()}};
      cut(b, blade, {.snapping = 0.1 * (seed % 5)});
    }
  }
}

TEST_CASE("more points than may be, and blades that are none, are refused") {
  Body b = block(2, 2, 2);
  CHECK_THROWS_AS(cut(b, Plane{1}.blade(-1, 3, -1, 3), {.capacity = 35}), Error);
  CHECK_NOTHROW(cut(b, Plane{1}.blade(-1, 3, -1, 3), {.capacity = 36}));
  const double nan = std::nan("");
  CHECK_THROWS_AS(SweptBlade("b", {{Point(0, 0, nan), Point(1, 0, 0)}, {Point(0, 1, 0), Point(1, 1, 0)}}),
                  Error);
  CHECK_THROWS_AS(SweptBlade("b", {{Point(0, 0, 0)}, {Point(0, 1, 0)}}), Error);
  CHECK_THROWS_AS(SweptBlade("b", {{Point(0, 0, 0), Point(1, 0, 0)}, {Point(0, 1, 0)}}), Error);
  CHECK_THROWS_AS(check_rules("here", {.snapping = 0.6}), Error);
  CHECK_THROWS_AS(check_rules("here", {.quality = std::nan("")}), Error);
}

}  // namespace test_cut_plan
