// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/implicit_surface.hpp>

#include "catch.hpp"

namespace test_implicit_surface {

using namespace sinew;

TEST_CASE("distances of simple shapes known by hand") {
  const SphereShape sphere{{1, 0, 0}, 2};
  CHECK(sphere({1, 5, 0}) == Approx(3));
  CHECK(sphere({1, 0, 0}) == Approx(-2));
  const CapsuleShape capsule{{0, 0, 0}, {2, 0, 0}, 0.5};
  CHECK(capsule({1, 2, 0}) == Approx(1.5));
  CHECK(capsule({5, 4, 0}) == Approx(4.5));  // 3, 4, 5 from its end
  CHECK(capsule({1, 0, 0.25}) == Approx(-0.25));
  CHECK(CapsuleShape{{1, 1, 1}, {1, 1, 1}, 1}({1, 1, 3}) == Approx(1));  // a sphere
  const BoxShape box{{0, 0, 0}, {2, 4, 6}};
  CHECK(box({1, 2, 0.5}) == Approx(-0.5));
  CHECK(box({5, 8, 3}) == Approx(5));  // 3, 4, 5 from an edge
  CHECK(box({2, 1, 1}) == 0);
}

TEST_CASE("an ellipsoid's field is the distance to first order") {
  const EllipsoidShape ball{{0, 0, 0}, {2, 2, 2}};
  CHECK(ball({3, 0, 4}) == Approx(3));
  const EllipsoidShape e{{1, 1, 1}, {3, 2, 1}};
  CHECK(e({4, 1, 1}) == Approx(0).margin(1e-15));
  CHECK(e({1, 1, 1}) == -1);              // its centre, where the formula is 0 / 0
  for (int axis = 0; axis < 3; ++axis) {  // 1e-4 outside and inside of a pole
    const Eigen::Vector3d pole = e.center + e.radii[axis] * Eigen::Vector3d::Unit(axis);
    CHECK(e(pole + 1e-4 * Eigen::Vector3d::Unit(axis)) == Approx(1e-4).epsilon(1e-3));
    CHECK(e(pole - 1e-4 * Eigen::Vector3d::Unit(axis)) == Approx(-1e-4).epsilon(1e-3));
  }
}

TEST_CASE("smooth minimum") {
  CHECK(smooth_minimum(1, 3, 0) == 1);
  CHECK(smooth_minimum(3, 1, 1) == 1);              // further apart than k
  CHECK(smooth_minimum(2, 2, 0.8) == Approx(1.8));  // k / 4 lower where equal
  CHECK(smooth_minimum(1, 1.5, 1) == Approx(1 - 0.25 / 4));
  CHECK(smooth_minimum(1, 1.5, 1) == smooth_minimum(1.5, 1, 1));
  const SmoothUnion both{SphereShape{{0, 0, 0}, 1}, SphereShape{{3, 0, 0}, 1}, 0.5};
  CHECK(both({0, 0, 0}) == -1);
  CHECK(both({1.5, 0, 0}) == Approx(0.5 - 0.125));
  const SmoothSubtraction shell{SphereShape{{0, 0, 0}, 2}, SphereShape{{0, 0, 0}, 1}, 0.0};
  CHECK(shell({0, 0, 0}) == 1);
  CHECK(shell({1.5, 0, 0}) == Approx(-0.5));
  CHECK(shell({3, 0, 0}) == 1);
}

TEST_CASE("the liver lies inside its box and has the shape it promises") {
  const LiverShape liver;
  const Eigen::Vector3d lo = LiverShape::box_min(), hi = LiverShape::box_max();
  constexpr int n = 60;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int face = 0; face < 6; ++face) {
        Eigen::Vector3d t;
        t[face / 2] = face % 2, t[(face / 2 + 1) % 3] = double(i) / n, t[(face / 2 + 2) % 3] = double(j) / n;
        if (!(liver(lo + (hi - lo).cwiseProduct(t)) > 0.004)) FAIL("the body comes near the box");
      }
  CHECK(liver({-0.06, 0, 0}) < -0.04);       // inside the right lobe
  CHECK(liver({0.08, 0.02, 0.01}) < -0.02);  // inside the left lobe
  CHECK(liver({0.0, -0.04, -0.014}) > 0);    // hollow underside
  CHECK(liver({0.024, -0.015, 0.05}) > 0);   // notch: outside, between points of both lobes that are inside
  CHECK(liver({-0.01, -0.015, 0.045}) < 0);
  CHECK(liver({0.06, 0.0, 0.03}) < 0);
}

}  // namespace test_implicit_surface
