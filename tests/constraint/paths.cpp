// SPDX-License-Identifier: BSL-1.0
#include "moving_point.hpp"

#include <sinew/constraint/fixed_rotation.hpp>
#include <sinew/constraint/hermite_spline.hpp>
#include <sinew/constraint/parabolic.hpp>

#include <numbers>

namespace test_paths {

using namespace sinew;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using moving::at;
using moving::elsewhere;
using moving::holds;
using moving::near;
using moving::two;
using one::ready;
using one::refuses;

TEST_CASE("points move along a Hermite spline") {
  using Spline = HermiteSplineConstraint<Vec3d>;
  // slopes of s of 1: s = u, and the path is the cubic alone
  Spline spline{.indices = {1},
                .beginTime = 1,
                .endTime = 3,
                .x0 = {1, 0, 0},
                .dx0 = {0, 3, 0},
                .x1 = {0, 2, 1},
                .dx1 = {0, 0, -2},
                .sx0 = {5, 1},
                .sx1 = {5, 1}};
  spline = ready(spline, two);
  CHECK_FALSE(holds(spline));
  CHECK(at(spline, 0.9).first == elsewhere);
  CHECK(near(at(spline, 1).first, {1, 0, 0}));
  CHECK(holds(spline));
  CHECK(near(at(spline, 1).second, {0, 1.5, 0}));  // dX0 a second of 2 s
  // half way: (X0 + X1)/2 + (dX0 - dX1)/8, and (3 (X1 - X0)/2 - (dX0 + dX1)/4) / 2 s
  CHECK(near(at(spline, 2).first, Vector3d(0.5, 1, 0.5) + Vector3d(0, 3, 2) / 8));
  CHECK(near(at(spline, 2).second, (1.5 * Vector3d(-1, 2, 1) - Vector3d(0, 3, -2) / 4) / 2));
  CHECK(near(at(spline, 3).first, {0, 2, 1}));
  CHECK(near(at(spline, 3).second, {0, 0, -1}));
  CHECK_FALSE(holds(spline));
  CHECK(at(spline, 3.1).first == elsewhere);
  CHECK(at(spline, 3.1).second == elsewhere);

  // slopes of s of 0, as SOFA has them when they are not given: a start and an end at rest
  spline.sx0 = spline.sx1 = {0, 0};
  spline = ready(spline, two);
  CHECK(at(spline, 1).second.norm() == 0);
  CHECK(at(spline, 3).second.norm() == 0);
  CHECK(near(at(spline, 2).first, Vector3d(0.5, 1, 0.5) + Vector3d(0, 3, 2) / 8));
  const double u = 0.25, s = 3 * u * u - 2 * u * u * u;
  const Vector3d cubic = Vector3d(1, 0, 0) * (2 * s * s * s - 3 * s * s + 1) +
                         Vector3d(0, 3, 0) * s * (1 - s) * (1 - s) + Vector3d(0, 2, 1) * s * s * (3 - 2 * s) +
                         Vector3d(0, 0, -2) * s * s * (s - 1);
  CHECK(near(at(spline, 1.5).first, cubic));

  refuses(Spline{.indices = {2}, .endTime = 1},
          two,
          {},
          {"body", "HermiteSplineConstraint<Vec3d>", "indices has 2"});
  refuses(
      Spline{.indices = {1}, .beginTime = 1, .endTime = 1}, two, {}, {"BeginTime is 1 s and EndTime 1 s"});
  refuses(Spline{.indices = {1}, .endTime = 1, .dx1 = {0, one::notANumber, 0}}, two, {}, {"dX1 is nan"});
  CHECK(error_of([] { ready(Spline{}, two); }).empty());  // of no points
}

TEST_CASE("points fly along a parabola") {
  using Parabola = ParabolicConstraint<Vec3d>;
  // a throw: x = 4 t, z = 10 t - 5 t^2, which is 0 at 0 and 2 s; through the place at 0.5 s
  Parabola thrown{
      .indices = {1}, .p1 = {0, 1, 0}, .p2 = {2, 1, 3.75}, .p3 = {8, 1, 0}, .beginTime = 1, .endTime = 3};
  thrown = ready(thrown, two);
  CHECK_FALSE(holds(thrown));
  CHECK(at(thrown, 0.5).first == elsewhere);
  for (const double t : {0.0, 0.5, 0.8, 1.0, 1.7, 2.0}) {
    CHECK(near(at(thrown, 1 + t).first, {4 * t, 1, 10 * t - 5 * t * t}));
    CHECK(near(at(thrown, 1 + t).second, {4, 0, 10 - 10 * t}));
    CHECK(holds(thrown) == (t < 2));
  }
  CHECK(at(thrown, 3.5).second == elsewhere);
  // P2 outside of P1 and P3 is on the same parabola
  thrown.p2 = {12, 1, -15};
  thrown = ready(thrown, two);
  CHECK(near(at(thrown, 1.5).first, {2, 1, 3.75}));
  // on their line there is a straight way, even where P2 is P1
  thrown.p2 = thrown.p1;
  thrown = ready(thrown, two);
  CHECK(near(at(thrown, 1.5).first, {2, 1, 0}));

  // rigid bodies keep their orientation
  Rigid3d::VecCoord body(1);
  body[0].orientation = AngleAxisd(1, Vector3d::UnitX());
  auto rigid = ready(
      ParabolicConstraint<Rigid3d>{.indices = {0}, .p2 = {1, 1, 0}, .p3 = {2, 0, 0}, .endTime = 1}, body);
  auto x = body;
  Rigid3d::VecDeriv v(1, Rigid3d::Deriv::Ones());
  rigid.projectPosition(0.5, x);
  rigid.projectVelocity(0.5, v);
  CHECK(near(x[0].center, {1, 1, 0}));
  CHECK(x[0].orientation.coeffs() == body[0].orientation.coeffs());
  CHECK(v[0].tail<3>().norm() == 0);
  CHECK(near(v[0].head<3>(), {2, 0, 0}));

  refuses(Parabola{.indices = {2}, .endTime = 1},
          two,
          {},
          {"body", "ParabolicConstraint<Vec3d>", "indices has 2"});
  refuses(Parabola{.indices = {1}, .p3 = {1, 0, 0}}, two, {}, {"BeginTime is 0 s and EndTime 0 s"});
  refuses(Parabola{.indices = {1}, .p2 = {1, 0, 0}, .endTime = 1}, two, {}, {"P1 and P3 are one point"});
  refuses(Parabola{.indices = {1}, .p2 = {1, 5, 0}, .p3 = {1, 0, 0}, .endTime = 1},
          two,
          {},
          {"P2 is right above P1 or P3"});
  refuses(Parabola{.indices = {1}, .p2 = {one::notANumber, 5, 0}, .p3 = {1, 0, 0}, .endTime = 1},
          two,
          {},
          {"P2 is nan"});
}

namespace {

using Fixed = FixedRotationConstraint<Rigid3d>;

Rigid3d::VecCoord turned(AngleAxisd const& rotation) {
  Rigid3d::VecCoord x(1);
  x[0].center = {1, 2, 3};
  x[0].orientation = rotation;
  return x;
}
Quaterniond from(Rigid3d::VecCoord const& rest, Rigid3d::VecCoord const& x) {
  return x[0].orientation * rest[0].orientation.conjugate();
}

}  // namespace

TEST_CASE("rigid bodies do not turn about fixed axes") {
  const auto rest = turned(AngleAxisd(0.3, Vector3d(1, 1, 1).normalized()));
  const Quaterniond rotation(AngleAxisd(1.1, Vector3d(1, -2, 2).normalized()));
  auto placed = [&](Fixed& c) {
    auto x = rest;
    x[0].orientation = rotation * rest[0].orientation;
    c.projectPosition(0, x);
    CHECK(near(x[0].center, {1, 2, 3}));
    return x;
  };
  auto free = [&](Fixed const& c, Vector3d const& w) {
    Rigid3d::VecDeriv v(1);
    v[0] << 1, 2, 3, w;
    c.projectVelocity(0, v);
    CHECK(near(v[0].head<3>(), {1, 2, 3}));
    return Vector3d(v[0].tail<3>());
  };
  const Vector3d w(0.5, -1, 2);

  auto none = ready(Fixed{}, rest);
  CHECK(from(rest, placed(none)).isApprox(rotation, 1e-14));
  CHECK(free(none, w) == w);

  auto all = ready(Fixed{.fixedXRotation = true, .fixedYRotation = true, .fixedZRotation = true}, rest);
  CHECK(placed(all)[0].orientation.isApprox(rest[0].orientation, 1e-15));
  CHECK(free(all, w).norm() == 0);

  // free about y alone: what is left of a turn is its twist about y
  auto hinge = ready(Fixed{.fixedXRotation = true, .fixedZRotation = true}, rest);
  const Quaterniond left = from(rest, placed(hinge));
  CHECK(std::abs(left.x()) + std::abs(left.z()) < 1e-15);
  CHECK(left.y() / left.w() == Approx(rotation.y() / rotation.w()));
  CHECK(near(free(hinge, w), {0, -1, 0}));

  // not about y: the twist about it is taken away, and the rest of the turn stays
  auto noTwist = ready(Fixed{.fixedYRotation = true}, rest);
  const auto x = placed(noTwist);
  const Quaterniond swing = from(rest, x);
  CHECK(std::abs(swing.y()) < 1e-15);
  CHECK(near(Vector3d(swing * Vector3d::UnitY()), Vector3d(rotation * Vector3d::UnitY())));
  // and it stays so to first order under the angular velocities that are left
  const Vector3d kept = free(noTwist, w);
  CHECK(kept.norm() > 0.1);
  const double h = 1e-5;
  auto ahead = x;
  Rigid3d::Deriv step;
  step << 0, 0, 0, h * kept;
  Rigid3d::increment(ahead[0], step);
  CHECK(std::abs(from(rest, ahead).y()) < 1e-9);  // h^2
  step.tail<3>() = h * w;
  ahead = x;
  Rigid3d::increment(ahead[0], step);
  CHECK(std::abs(from(rest, ahead).y()) > 1e-6);  // what was taken away would twist
}

TEST_CASE("a half turn has no twist about the axes across it") {
  const auto rest = turned(AngleAxisd(0, Vector3d::UnitX()));
  auto c = ready(Fixed{.fixedZRotation = true}, rest);
  auto x = turned(AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
  x[0].orientation.w() = 0;  // exactly
  const auto before = x;
  c.projectPosition(0, x);
  CHECK(x == before);
  CHECK(c.free[0].allFinite());
}

}  // namespace test_paths
