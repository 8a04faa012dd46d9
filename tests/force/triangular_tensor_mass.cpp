// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/triangular_tensor_mass.hpp>

#include <cmath>

namespace test_triangular_tensor_mass {

using namespace sinew;
using Membrane = TriangularTensorMassForceField<Vec3d>;

namespace {

const std::vector<Triangle> pair{{0, 1, 2}, {2, 3, 0}};
const Vec3d::VecCoord rest{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
constexpr double E = 7, nu = 0.2;

Vec3d::VecDeriv force_of(Eigen::Matrix3d const& slope) {
  auto field = one::ready(Membrane{.youngModulus = E, .poissonRatio = nu}, rest, {.triangles = pair});
  Vec3d::VecCoord x;
  for (auto const& p : rest) x.push_back(p + slope * p);
  return one::force(field, x);
}

}  // namespace

TEST_CASE("a membrane of tensor mass has the stresses of plane elasticity, however large the strain") {
  const double lambda = E * nu / (1 - nu * nu), mu = E / (1 + nu);
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  slope(0, 0) = 0.7;
  auto f = force_of(slope);
  CHECK(-(f[1][0] + f[2][0]) == Approx((lambda + mu) * 0.7 * 2));
  CHECK(-(f[2][1] + f[3][1]) == Approx(lambda * 0.7 * 2));
  slope.setZero();
  slope(0, 1) = 0.3;  // e_xy = 0.15
  f = force_of(slope);
  CHECK(-(f[1][1] + f[2][1]) == Approx(mu * 0.15 * 2));
  CHECK(-(f[2][0] + f[3][0]) == Approx(mu * 0.15 * 2));
  // out of its plane it is held as by a tension lambda + mu
  slope.setZero();
  slope(2, 0) = 0.4;
  f = force_of(slope);
  CHECK(-(f[1][2] + f[2][2]) == Approx((lambda + mu) * 0.4 * 2));
  CHECK(std::abs(f[1][0] + f[2][0]) < 1e-12);
}

TEST_CASE("stiffness of a tensor mass by the angles of its triangles, as Delingette writes it") {
  // K_kl = -cot_j (lambda + mu)/2 I + lambda/(4 A) a b' + mu/(8 A) b a', a and b the sides from point j to k
  // and l
  const Vec3d::VecCoord x{{0, 0, 0}, {3, 0.5, 1}, {1, 2, -0.5}};
  const std::vector<Triangle> one{{0, 1, 2}};
  auto field = one::ready(Membrane{.youngModulus = E, .poissonRatio = nu}, x, {.triangles = one});
  one::force(field, x);
  const double lambda = E * nu / (1 - nu * nu), mu = E / (1 + nu);
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
    const Eigen::Vector3d a = x[k] - x[j], b = x[l] - x[j];
    const double twice = a.cross(b).norm();
    const Eigen::Matrix3d K = -a.dot(b) / twice * (lambda + mu) / 2 * Eigen::Matrix3d::Identity() +
                              lambda / (2 * twice) * a * b.transpose() + mu / (4 * twice) * b * a.transpose();
    for (int c = 0; c < 3; ++c) {
      Vec3d::VecDeriv u(3, Eigen::Vector3d::Zero());
      u[l][c] = 1;
      const auto df = one::product(field, u, 1, 0);
      CHECK((df[k] + K.col(c)).norm() < 1e-12 * (1 + df[k].norm()));
    }
  }
}

TEST_CASE("a tensor mass says what is wrong") {
  one::refuses(Membrane{}, rest, {}, {"body: TriangularTensorMassForceField<Vec3d>", "no triangle"});
  auto flat = rest;
  for (auto& p : flat) p[1] = 0;
  one::refuses(Membrane{}, flat, {.triangles = pair}, {"triangle 0 has no area at rest"});
  const std::vector<Triangle> wrong{{0, 1, 4}};
  one::refuses(Membrane{}, rest, {.triangles = wrong}, {"triangle 0 refers to point 4"});
}

}  // namespace test_triangular_tensor_mass
