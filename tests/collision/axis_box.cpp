// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/axis_box.hpp>
#include <sinew/collision/packed_box.hpp>

#include "catch.hpp"

#include <random>

namespace test_axis_box {

using namespace sinew;
using Point = Eigen::Vector3d;

TEST_CASE("an empty box lies nowhere") {
  const AxisBox none, box{{0, 0, 0}, {1, 1, 1}};
  CHECK(none.empty());
  CHECK_FALSE(box.empty());
  CHECK(AxisBox{{0, 0, 0}, {1, -1, 1}}.empty());
  CHECK_FALSE(none.overlaps(box));
  CHECK_FALSE(box.overlaps(none, 1e300));
  CHECK_FALSE(none.overlaps(none, 1e300));
  CHECK(none.halfArea() == 0);
  AxisBox both = none;
  both.include(box);
  CHECK(both == box);
  both.include(none);
  CHECK(both == box);
}

TEST_CASE("a box grows around points and boxes") {
  AxisBox box;
  box.include(Point(1, 2, 3));
  CHECK_FALSE(box.empty());
  CHECK(box == AxisBox{{1, 2, 3}, {1, 2, 3}});
  box.include(Point(0, 5, 2));
  CHECK(box == AxisBox{{0, 2, 2}, {1, 5, 3}});
  CHECK(box.grown(0.5) == AxisBox{{-0.5, 1.5, 1.5}, {1.5, 5.5, 3.5}});
  CHECK(box.center() == Point(0.5, 3.5, 2.5));
  CHECK(box.halfArea() == 1 * 3 + 3 * 1 + 1 * 1);
  CHECK(box.swept({{2, 2, 2}, {3, 5, 3}}) == AxisBox{{0, 2, 2}, {3, 5, 3}});
}

TEST_CASE("boxes that touch overlap, and the margin is a gap along each axis") {
  const AxisBox box{{0, 0, 0}, {1, 1, 1}};
  CHECK(box.overlaps({{1, 1, 1}, {2, 2, 2}}));
  CHECK_FALSE(box.overlaps({{1.25, 0, 0}, {2, 1, 1}}));
  CHECK(box.overlaps({{1.25, 1.25, 0}, {2, 2, 1}}, 0.25));
  CHECK_FALSE(box.overlaps({{1.25, 1.5, 0}, {2, 2, 1}}, 0.25));
  CHECK_FALSE(box.overlaps({{0.75, 0, 0}, {2, 1, 1}}, -0.5));
  CHECK(box.overlaps({{0.25, 0, 0}, {2, 1, 1}}, -0.5));
  CHECK(box.contains({1, 0.5, 0}));
  CHECK_FALSE(box.contains({1, 0.5, -0.1}));
}

TEST_CASE("the distance of boxes is that of their nearest points") {
  const AxisBox box{{0, 0, 0}, {1, 1, 1}};
  CHECK(box.distance({{0.5, 0.5, 0.5}, {2, 2, 2}}) == 0);
  CHECK(box.distance({{4, -5, 0.5}, {5, -4, 0.6}}) == 5);  // 3 and 4
  CHECK(box.squaredDistance({{2, 3, 3}, {2, 3, 3}}) == 1 + 4 + 4);
}

TEST_CASE("where a ray enters a box") {
  const AxisBox box{{1, 1, 1}, {2, 3, 4}};
  CHECK(box.rayEntry({0, 2, 2}, {1, 0, 0}, 10) == 1);
  CHECK(box.rayEntry({0, 2, 2}, {2, 0, 0}, 10) == 0.5);
  CHECK(box.rayEntry({3, 2, 2}, {-1, 0, 0}, 10) == 1);
  CHECK(box.rayEntry({1.5, 2, 2}, {1, 0, 0}, 10) == 0);
  CHECK(box.rayEntry({0, 2, 2}, {1, 0, 0}, 0.5) > 0.5);
  CHECK(box.rayEntry({0, 2, 2}, {-1, 0, 0}, 10) > 10);
  CHECK(box.rayEntry({0, 1, 1}, {1, 0, 0}, 10) == 1);  // along an edge
  CHECK(box.rayEntry({0, 0.5, 1}, {1, 0, 0}, 10) > 10);
  CHECK(box.rayEntry({0, 0, 0}, {1, 1, 1}, 10) == 1);
  CHECK(AxisBox{}.rayEntry({0, 0, 0}, {1, 1, 1}, 10) > 10);
}

// to the last bit, so also where rounding decides: corners and margins are few and not binary fractions
TEMPLATE_TEST_CASE("a packed box says what the box says", "", double, float) {
  using Real = TestType;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> corner(0, 9), size(0, 3), margin(-2, 4);
  auto box = [&] {
    BasicAxisBox<Real> b;
    for (int c = 0; c < 3; ++c) {
      b.min[c] = Real(0.1) * Real(corner(random));
      b.max[c] = b.min[c] + Real(0.1) * Real(size(random));
    }
    return b;
  };
  int overlapping = 0, differentWithout = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto a = box(), b = box();
    const Real m = Real(0.1) * Real(margin(random));
    auto const pa = PackedBox<Real>::of(a), pb = PackedBox<Real>::of(b);
    REQUIRE(pa.overlaps(pb, m) == a.overlaps(b, m));
    REQUIRE(pb.overlaps(pa, m) == a.overlaps(b, m));
    REQUIRE(pa.halfArea() == a.halfArea());
    auto joined = a;
    joined.include(b);
    auto packed = pa;
    packed.include(pb);
    REQUIRE(packed.box() == joined);
    overlapping += a.overlaps(b, m);
    differentWithout += a.overlaps(b, m) != a.overlaps(b, 0);
  }
  CHECK(overlapping > 1000);
  CHECK(differentWithout > 1000);
  const auto none = PackedBox<Real>::of({});
  CHECK_FALSE(none.overlaps(PackedBox<Real>::of(box()), 1000));
  CHECK_FALSE(none.overlaps(none, 1000));
  CHECK(none.halfArea() == 0);
}

}  // namespace test_axis_box
