// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/core/data_types.hpp>

namespace test_data_types {

using namespace sinew;

static_assert(std::is_same_v<Vec3d::Coord, Vec3d::Deriv>);
static_assert(!std::is_same_v<Rigid3d::Coord, Rigid3d::Deriv>,
              "positions of rigids are not their velocities");
static_assert(sizeof(Rigid3d::Coord) == 7 * sizeof(double) && sizeof(Rigid3f::Coord) == 7 * sizeof(float));
static_assert(Vec1f::size == 1 && Vec2d::size == 2 && Vec6d::size == 6 && Rigid2d::size == 3 &&
              Rigid3d::size == 6);
static_assert(data_types_name<Rigid3f>::value == "Rigid3f" && data_types_name<Vec6d>::value == "Vec6d");
static_assert(data_types_name<WithLanes<Vec3f, 1>>::value == "Vec3fx1" &&
              data_types_name<WithLanes<Vec3d, 16>>::value == "Vec3dx16");
static_assert(lane_width<Vec3d>() == native_width<double> && lane_width<Vec3f>() == native_width<float> &&
              lane_width<Rigid3d>() == 1 && lane_width<WithLanes<Vec3d, 2>>() == 2);
template <class D>
struct HeavyLaw {};
template <class D>
struct LightLaw {
  static constexpr bool oneByOne = true;
};
static_assert(element_lanes<HeavyLaw, Vec3d>() == native_width<double> &&
              element_lanes<LightLaw, Vec3d>() == 1 && element_lanes<LightLaw, WithLanes<Vec3d, 2>>() == 2);

TEST_CASE("increment and difference of rigid positions undo each other") {
  Rigid3d::Coord a;
  Rigid3d::Deriv step;
  step << 1, 2, 3, 0.3, -0.4, 0.5;
  Rigid3d::increment(a, step);
  Rigid3d::Coord b = a;
  for (const double size : {1e-9, 1e-3, 1.0, 2.5}) {
    Rigid3d::Deriv d;
    d << 0.1, -0.2, 0.3, size * 0.6, 0, -size * 0.8;
    b = a;
    Rigid3d::increment(b, d);
    CHECK((Rigid3d::difference(a, b) - d).norm() < 1e-14 * (1 + d.norm()));
    CHECK(std::abs(b.orientation.norm() - 1) < 1e-15);
  }
}

TEST_CASE("increment turns about a world axis") {
  Rigid3d::Coord x;
  Rigid3d::Deriv quarter;
  const double pi = 3.14159265358979323846;
  quarter << 0, 0, 0, 0, 0, pi / 2;
  Rigid3d::increment(x, quarter);
  CHECK((x.orientation * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 1, 0)).norm() < 1e-15);
  quarter << 0, 0, 0, pi / 2, 0, 0;  // then about the world's x: y goes to z
  Rigid3d::increment(x, quarter);
  CHECK((x.orientation * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 0, 1)).norm() < 1e-15);
}

TEST_CASE("chart_rate is the derivative of exponential coordinates") {
  // exp(theta(t)) R0 moves with angular velocity w: differences of theta over 2e-5 against dexp^-1, whose
  // series is cut after the second power of theta (0.2)^4/720 = 2e-6
  Rigid3d::Deriv theta, v;
  theta << 0, 0, 0, 0.1, -0.15, 0.08;
  v << 0, 0, 0, 0.7, 0.2, -0.5;
  Rigid3d::Coord start, plus, minus;
  Rigid3d::increment(plus = start, theta);
  minus = plus;
  const double h = 1e-5;
  Rigid3d::increment(plus, (h * v).eval());
  Rigid3d::increment(minus, (-h * v).eval());
  const Rigid3d::Deriv rate =
      (Rigid3d::difference(start, plus) - Rigid3d::difference(start, minus)) / (2 * h);
  CHECK((rate - Rigid3d::chart_rate(theta, v)).norm() < 5e-6);
}

TEST_CASE("rigids in the plane") {
  Rigid2d::Coord x{{1, 2}, 0.5};
  Rigid2d::increment(x, {0.1, 0.2, 0.3});
  CHECK(x.orientation == Approx(0.8));
  CHECK((Rigid2d::difference({{1, 2}, 0.5}, x) - Rigid2d::Deriv(0.1, 0.2, 0.3)).norm() < 1e-15);
}

}  // namespace test_data_types
