// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/ellipsoid_force_field.hpp>

namespace test_ellipsoid_force_field {

using namespace sinew;
using Ellipsoid = EllipsoidForceField<Vec3d>;

namespace {

const Ellipsoid sample{.center = {1, 0, 0}, .vradius = {2, 3, 4}, .stiffness = 10, .damping = 0.5};

}  // namespace

TEST_CASE("an ellipsoid pushes points out along its axes, as far as they are inside in parts of the radius") {
  auto field = one::ready(sample, {{2, 0, 0}, {1, -1.5, 0}, {1, 0, 4.5}, {1, 0, 0}});
  const Vec3d::VecCoord x{{2, 0, 0}, {1, -1.5, 0}, {1, 0, 4.5}, {1, 0, 0}};
  auto f = one::force(field, x);
  CHECK(f[0].isApprox(Eigen::Vector3d(5, 0, 0)));
  CHECK(f[1].isApprox(Eigen::Vector3d(0, -5, 0)));
  CHECK(f[2].norm() == 0);
  CHECK(f[3].norm() < 1e-12);  // the centre has no direction
  // off the axes along the gradient of d^2/r^2
  const Eigen::Vector3d d(0.5, 1, -2), g(0.5 / 4, 1. / 9, -2. / 16);
  const double n = std::sqrt(d.dot(g));
  auto one = one::ready(sample, {{0, 0, 0}});
  CHECK(one::force(one, {Eigen::Vector3d(1, 0, 0) + d})[0].isApprox(10 * (1 - n) * g.normalized()));
  CHECK(one::force(one, {{2, 0, 0}}, {{0, 4, 0}})[0].isApprox(Eigen::Vector3d(5, -0.5 * 0.5 * 4, 0)));
  // with a negative stiffness those outside are pushed in
  auto inwards = sample;
  inwards.stiffness = -10;
  inwards = one::ready(inwards, x);
  f = one::force(inwards, x);
  CHECK(f[0].norm() == 0);
  CHECK(f[2].isApprox(Eigen::Vector3d(0, 0, -10 * 0.125)));
}

TEST_CASE("the tangent of an ellipsoid is the symmetric part of the slope of its force") {
  for (const double stiffness : {10., -10.}) {
    auto given = sample;
    given.stiffness = stiffness;
    auto field = one::ready(given, {{0, 0, 0}});
    const Eigen::Vector3d x = stiffness > 0 ? Eigen::Vector3d(1.5, 1, -1) : Eigen::Vector3d(2.5, 3, -2);
    const double h = 1e-6;
    Eigen::Matrix3d slope, tangent;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d u = Eigen::Vector3d::Unit(c);
      slope.col(c) = (one::force(field, {x + h * u})[0] - one::force(field, {x - h * u})[0]) / (2 * h);
      one::force(field, {x});
      tangent.col(c) = one::product(field, {u}, 1, 0)[0];
    }
    CHECK((tangent - (slope + slope.transpose()) / 2).norm() < 1e-7 * slope.norm());
  }
}

TEST_CASE("an ellipsoid says what is wrong") {
  one::refuses(Ellipsoid{.vradius = {1, 0, 1}}, {{0, 0, 0}}, {}, {"vradius", "0"});
}

}  // namespace test_ellipsoid_force_field
