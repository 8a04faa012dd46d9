// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/lagrangian/exact_line_search.hpp>

#include <algorithm>

namespace test_exact_line_search {

using namespace sinew;
using contact_potential::Slope;

TEST_CASE("the line search ends where a parabola has its least value, after one look") {
  int looks = 0;
  // 1/2 t^2 4 - 2 t + (t - 1)^2: its derivative 6 t - 4
  const double t = exact_line_search(
      -2,
      4,
      [](double at) {
        return Slope{2 * (at - 1), 2};
      },
      looks);
  CHECK(t == Approx(2. / 3).epsilon(1e-12));
  CHECK(looks <= 2);
}

TEST_CASE("the line search passes kinks of the curvature, and goes far where it has to") {
  // 1/2 t^2 c + s t + 1/2 k max(0, t - a)^2 with a contact that closes at a: c t + s + k (t - a) = 0 behind
  for (const double a : {0.01, 0.7, 3., 500.})
    for (const double k : {1e-3, 1., 1e6}) {
      const double c = 1e-3, s = -1;
      int looks = 0;
      const double t = exact_line_search(
          s,
          c,
          [&](double at) {
            return Slope{k * std::max(0., at - a), at > a ? k : 0};
          },
          looks);
      const double expected = std::max(std::min(-s / c, a), (k * a - s) / (c + k));
      CAPTURE(a, k, t, expected, looks);
      // the derivative is a thousandth of that at 0
      CHECK(std::abs(c * t + s + k * std::max(0., t - a)) <= 1e-3);
      CHECK(std::abs(t - expected) <= 1e-3 / (t > a ? c + k : c) * 1.01);
      CHECK(looks < 50);
    }
}

TEST_CASE("a line without any curvature ends the search without a step that is not finite") {
  int looks = 0;
  const double t = exact_line_search(
      -1,
      0,
      [](double) {
        return Slope{0, 0};
      },
      looks);
  CHECK(std::isfinite(t));
  CHECK(looks <= 50);
}

}  // namespace test_exact_line_search
