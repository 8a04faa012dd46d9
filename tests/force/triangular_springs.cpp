// SPDX-License-Identifier: BSL-1.0
// Membranes of springs: moduli of a stretched sheet in closed form, large strains by the energy of St Venant
// and Kirchhoff, tangents by differences.
#include "one_component.hpp"

#include <sinew/force/triangular_biquadratic_springs.hpp>
#include <sinew/force/triangular_quadratic_springs.hpp>

#include <cmath>

namespace test_triangular_springs {

using namespace sinew;
using Quadratic = TriangularQuadraticSpringsForceField<Vec3d>;
using Biquadratic = TriangularBiquadraticSpringsForceField<Vec3d>;

namespace {

const std::vector<Triangle> pair{{0, 1, 2}, {2, 3, 0}};
// a square of 2 m, stretched along x and y
Vec3d::VecCoord sheet(double x, double y) {
  return {{0, 0, 1}, {2 * x, 0, 1}, {2 * x, 2 * y, 1}, {0, 2 * y, 1}};
}
template <class F>
double right_side(F& field, double x, double y) {
  const auto f = one::force(field, sheet(x, y));
  return -(f[1][0] + f[2][0]);
}

// f = -dE/dx and df = K dx by central differences: truncation h^2, rounding 1e-16/h
template <class F>
void differs(F field, Vec3d::VecCoord const& x) {
  const double h = 1e-6;
  Vec3d::VecDeriv u;
  for (std::size_t i = 0; i < x.size(); ++i)
    u.push_back({std::sin(3. * double(i)), std::cos(5. * double(i)), std::sin(7. * double(i) + 1)});
  auto moved = [&](double by) {
    auto y = x;
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += by * u[i];
    return y;
  };
  const auto plus = one::force(field, moved(h)), minus = one::force(field, moved(-h)),
             f = one::force(field, x), ku = one::product(field, u, 1, 0);
  double power = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    power += f[i].dot(u[i]);
    CHECK(((plus[i] - minus[i]) / (2 * h) - ku[i]).norm() < 1e-6 * (1 + ku[i].norm()));
  }
  CHECK((potential_energy(field, moved(-h)) - potential_energy(field, moved(h))) / (2 * h) ==
        Approx(power).epsilon(1e-6).margin(1e-6));
}

}  // namespace

TEST_CASE("a sheet stretched by a little has the stress of plane elasticity, in SOFA's moduli") {
  // sigma_x = (lambda + 2 mu) e_x + lambda e_y in Delingette's moduli halved: his energy is
  // lambda/2 tr^2 + mu tr(e^2) with lambda = E nu/(1 - nu^2), mu = E/(1 + nu), over 2
  const double E = 7, nu = 0.2, lambda = E * nu / (1 - nu * nu), mu = E / (1 + nu), small = 1e-6;
  auto quadratic =
      one::ready(Quadratic{.youngModulus = E, .poissonRatio = nu}, sheet(1, 1), {.triangles = pair});
  auto biquadratic =
      one::ready(Biquadratic{.youngModulus = E, .poissonRatio = nu}, sheet(1, 1), {.triangles = pair});
  const double own = right_side(quadratic, 1 + small, 1) / (2 * small),
               other = right_side(quadratic, 1, 1 + small) / (2 * small);
  CHECK(own == Approx(lambda + mu).epsilon(1e-5));
  CHECK(other == Approx(lambda).epsilon(1e-5));
  CHECK(right_side(biquadratic, 1 + small, 1) / (2 * small) == Approx(own).epsilon(1e-5));
  CHECK(right_side(biquadratic, 1, 1 + small) / (2 * small) == Approx(other).epsilon(1e-5));
}

TEST_CASE("squares of lengths are the energy of St Venant and Kirchhoff") {
  const double E = 11, nu = 0.3, lambda = E * nu / (1 - nu * nu), mu = E / (1 + nu);
  auto field =
      one::ready(Biquadratic{.youngModulus = E, .poissonRatio = nu}, sheet(1, 1), {.triangles = pair});
  // strains of Green: (s^2 - 1)/2 along each axis; the sheet has 4 m^2
  for (const double s : {1.1, 1.7, 2.5}) {
    const double e = (s * s - 1) / 2, d = (1.2 * 1.2 - 1) / 2, trace = e + d;
    CHECK(potential_energy(field, sheet(s, 1.2)) ==
          Approx(4 * (lambda / 2 * trace * trace + mu / 2 * (e * e + d * d))));
  }
}

TEST_CASE("a sheet that shrinks is pushed back by the third power of what its area lost") {
  const double E = 5, nu = 0.25, K = 3 * (E * nu / (1 - nu * nu) + E / (1 + nu));
  const Biquadratic sample{.youngModulus = E, .poissonRatio = nu};
  auto with = one::ready(sample, sheet(1, 1), {.triangles = pair});
  Biquadratic plain = sample;
  plain.compressible = false;
  auto without = one::ready(plain, sheet(1, 1), {.triangles = pair});
  CHECK(right_side(with, 1.5, 1) == Approx(right_side(without, 1.5, 1)));
  // dE/dx over the right side: K (A/A0 - 1)^3 times its length
  CHECK(right_side(with, 0.6, 1) - right_side(without, 0.6, 1) == Approx(K * std::pow(-0.4, 3) * 2));
}

TEST_CASE("forces of triangular springs are slopes, and the tangent is exact") {
  Vec3d::VecCoord bent = sheet(1.3, 0.7);
  bent[2] += Eigen::Vector3d(0.1, -0.2, 0.6);
  bent[0] += Eigen::Vector3d(-0.1, 0.1, -0.3);
  for (const bool angular : {true, false}) {
    differs(one::ready(Quadratic{.useAngularSprings = angular}, sheet(1, 1), {.triangles = pair}), bent);
    differs(one::ready(Biquadratic{.useAngularSprings = angular}, sheet(1.6, 1.6), {.triangles = pair}),
            bent);
  }
}

TEST_CASE("damping of triangular springs opposes rates of length") {
  auto field = one::ready(
      Quadratic{.youngModulus = 9, .poissonRatio = 0, .dampingRatio = 0.5}, sheet(1, 1), {.triangles = pair});
  Vec3d::VecDeriv v(4, Eigen::Vector3d::Zero());
  v[1][0] = v[2][0] = 2e-3;  // e_x grows by 1e-3/s, which counts as 0.5e-3
  const auto f = one::force(field, sheet(1, 1), v);
  CHECK(-(f[1][0] + f[2][0]) == Approx(9 * 0.5e-3 * 2));
  auto turning = v;
  for (std::size_t i = 0; i < 4; ++i) turning[i] = Eigen::Vector3d(0, 0, 1).cross(sheet(1, 1)[i]);
  for (auto const& force : one::force(field, sheet(1, 1), turning)) CHECK(force.norm() < 1e-12);
}

TEST_CASE("triangular springs say what is wrong") {
  one::refuses(
      Quadratic{}, sheet(1, 1), {}, {"body: TriangularQuadraticSpringsForceField<Vec3d>", "no triangle"});
  one::refuses(Biquadratic{}, sheet(1, 0), {.triangles = pair}, {"triangle 0 has no area at rest"});
  one::refuses(Biquadratic{.poissonRatio = 1}, sheet(1, 1), {.triangles = pair}, {"poissonRatio is 1"});
  const std::vector<Triangle> wrong{{0, 1, 4}};
  one::refuses(Quadratic{}, sheet(1, 1), {.triangles = wrong}, {"triangle 0 refers to point 4"});
  // flat for a moment: no direction, no push, nothing that is no number
  auto field = one::ready(Biquadratic{}, sheet(1, 1), {.triangles = pair});
  for (auto const& f : one::force(field, sheet(1, 0))) CHECK(f.allFinite());
}

}  // namespace test_triangular_springs
