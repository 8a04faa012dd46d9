// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/polynomial_rest_shape_springs.hpp>

#include <cmath>

namespace test_polynomial_rest_shape_springs {

using namespace sinew;
using Springs = PolynomialRestShapeSpringsForceField<Vec3d>;

TEST_CASE("a point is held by a polynomial of its distance over a length") {
  auto springs = one::ready(Springs{.polynomialStiffness = {10, 20},
                                    .polynomialDegree = {2},
                                    .initialLength = {2},
                                    .smoothShift = -1000},
                            {{1, 0, 0}});
  // 3 m away: e = 1.5
  CHECK(one::force(springs, {{1, 3, 0}})[0].isApprox(Eigen::Vector3d(0, -(15 + 20 * 2.25), 0)));
  CHECK(one::force(springs, {{1, 0, 0}})[0].norm() == 0);
  // E = L int P de = 2 (5 e^2 + 20/3 e^3), which 16 Gauss points have exactly
  CHECK(potential_energy(springs, {{1, 3, 0}}) == Approx(2 * (5 * 2.25 + 20. / 3 * 3.375)));
  // smoothed: the direction is d/sqrt(l^2 + exp(s - c l^2))
  auto smooth = springs;
  smooth.smoothShift = 0.5, smooth.smoothScale = 0.1;
  smooth = one::ready(smooth, {{1, 0, 0}});
  CHECK(one::force(smooth, {{1, 3, 0}})[0][1] ==
        Approx(-(15 + 20 * 2.25) * 3 / std::sqrt(9 + std::exp(0.5 - 0.9))));
}

TEST_CASE("points have polynomials, lengths and places of their own") {
  auto springs = one::ready(Springs{.points = {2, 0},
                                    .polynomialStiffness = {1, 2, 3},
                                    .polynomialDegree = {1, 2},
                                    .initialLength = {1, 2},
                                    .smoothShift = -1000,
                                    .externalRestShape = {{0, 0, 0}, {0, 0, 5}},
                                    .externalPoints = {1, 0}},
                            {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const auto f = one::force(springs, {{0, 2, 0}, {0, 0, 0}, {0, 0, 9}});
  CHECK(f[2].isApprox(Eigen::Vector3d(0, 0, -4)));
  CHECK(f[0].isApprox(Eigen::Vector3d(0, -5, 0)));
  CHECK(f[1].norm() == 0);
}

TEST_CASE("springs of polynomials to places say what is wrong") {
  const Vec3d::VecCoord two{{0, 0, 0}, {1, 0, 0}};
  one::refuses(
      Springs{.points = {2}}, two, {}, {"body: PolynomialRestShapeSpringsForceField<Vec3d>", "points has 2"});
  one::refuses(
      Springs{.polynomialDegree = {2}}, two, {}, {"polynomialStiffness has 1 coefficients", "says 2"});
  one::refuses(Springs{.polynomialDegree = {9}}, two, {}, {"polynomialDegree"});
  one::refuses(Springs{.initialLength = {1, 2, 3}}, two, {}, {"initialLength"});
  one::refuses(Springs{.externalPoints = {0}}, two, {}, {"external_rest_shape, which is not given"});
  one::refuses(
      Springs{.externalRestShape = {{0, 0, 0}}}, two, {}, {"external_rest_shape has 1 places for 2 points"});
}

}  // namespace test_polynomial_rest_shape_springs
