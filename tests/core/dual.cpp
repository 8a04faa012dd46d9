// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/core/dual.hpp>

namespace test_dual {

using namespace sinew;

namespace {

/// (x^2 y + 3) / sqrt(x) - y, which takes every operation.
template <class S>
S function(S x, S y) {
  using std::sqrt, sinew::sqrt;
  S f = x * x * y;
  f += S(3);
  f = f / sqrt(x);
  f -= y;
  f *= S(-1);
  return -f;
}
double slope_x(double x, double y) { return 1.5 * std::sqrt(x) * y - 1.5 / std::pow(x, 1.5); }
double slope_y(double x, double) { return std::pow(x, 1.5) - 1; }

}  // namespace

TEST_CASE("dual numbers carry the value and the exact slopes of a function") {
  const double x = 1.7, y = -0.6;
  Dual<double, 2> dx(x), dy(y);
  dx.slope[0] = 1, dy.slope[1] = 1;
  const auto f = function(dx, dy);
  CHECK(f.value == Approx(function(x, y)).epsilon(1e-15));
  CHECK(f.slope[0] == Approx(slope_x(x, y)).epsilon(1e-14));
  CHECK(f.slope[1] == Approx(slope_y(x, y)).epsilon(1e-14));
  // constants have no slope, and a factor that is none scales
  CHECK(Dual<double, 2>(3).slope[1] == 0);
  CHECK((2.0 * f).slope[0] == 2 * f.slope[0]);
  CHECK(f.through(1, 5).slope[1] == 5 * f.slope[1]);
  CHECK(select(true, f, dx).slope[0] == f.slope[0]);
  CHECK(select(false, f, dx).slope[0] == 1);
  CHECK(value_of(f) == f.value);
  CHECK(value_of(x) == x);
}

TEST_CASE("dual numbers of lanes are those of each lane") {
  using L = Lanes<double, 2>;  // SSE2: every x86-64 has it
  Dual<L, 1> x(L(0.0)), y(L(2.0));
  for (int l = 0; l < 2; ++l) x.value.set(l, 1 + l);
  x.slope[0] = L(1.0);
  const auto f = function(x, y);
  for (int l = 0; l < 2; ++l) {
    CHECK(lane(f.value, l) == Approx(function(1.0 + l, 2.0)).epsilon(1e-15));
    CHECK(lane(f.slope[0], l) == Approx(slope_x(1.0 + l, 2)).epsilon(1e-14));
  }
  const auto chosen = select(x.value > L(1.5), x, y);
  CHECK(lane(chosen.slope[0], 0) == 0);
  CHECK(lane(chosen.slope[0], 1) == 1);
}

}  // namespace test_dual
