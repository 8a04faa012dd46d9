// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/force/corotation.hpp>

#include <numbers>

namespace test_corotation {

using namespace sinew;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

const Vector3d axis = Vector3d(2, -1, 2) / 3;

UnitQuaternion<double> lanes_of(Quaterniond const& q) {
  double four[4];
  store(q, four);
  return unit_quaternion<double>(four);
}
Quaterniond rotation(Vector3d const& t) {
  return Quaterniond(t.norm() > 0 ? AngleAxisd(t.norm(), t.normalized()) : AngleAxisd(0, Vector3d::UnitX()));
}

}  // namespace

TEST_CASE("turns compose and turn vectors as quaternions do") {
  const Quaterniond a(AngleAxisd(0.7, axis)), b(AngleAxisd(2, Vector3d(0.6, 0, 0.8)));
  const Vector3d v(1, 2, 3);
  CHECK(((lanes_of(a) * lanes_of(b))(v)-a * (b * v)).norm() < 1e-14);
  CHECK((lanes_of(a).inverse()(v) - a.conjugate() * v).norm() < 1e-14);
}

// also where the series for small angles begin: sine of the half angle of 0.0316 and of 0.1
TEST_CASE("rotation vectors are found, and spins and torques go with them, at all angles") {
  for (const double angle : {0.0, 1e-9, 1e-4, 0.0632, 0.0633, 0.2003, 0.2004, 1.0, 3.0, 3.14}) {
    INFO("angle " << angle);
    const Vector3d t = angle * axis;
    Quaterniond q = rotation(t);
    CHECK((LocalRotation<double>(lanes_of(q)).vector - t).norm() < 1e-13);
    q.coeffs() *= -1;
    const LocalRotation<double> local(lanes_of(q));
    CHECK((local.vector - t).norm() < 1e-13);
    if (angle > 3.1) continue;  // differences would cross 180 degrees
    // dt = H w by differences and by dual numbers; m.dt = (H' m).w
    const Vector3d m(0.3, -2, 1);
    for (int c = 0; c < 3; ++c) {
      const double h = 1e-6;
      auto at = [&](double s) {
        return LocalRotation<double>(lanes_of(rotation(s * Vector3d::Unit(c)) * q)).vector;
      };
      const Vector3d slope = (at(h) - at(-h)) / (2 * h);
      Frames<Dual<double, 1>, 2> frames{};
      frames.orientation[1] = {q.w(), Vec<Dual<double, 1>, 3>(q.x(), q.y(), q.z())};
      for (auto& place : frames.place) place.setConstant(Dual<double, 1>(0));
      Vec<double, 6> spin = Vec<double, 6>::Zero();
      spin[c + 3] = 1;
      seed(frames, 1, spin, 0);
      const LocalRotation<Dual<double, 1>> dual(frames.orientation[1]);
      // rounding of the differences: 1e-16 / 1e-6
      for (int r = 0; r < 3; ++r) CHECK(dual.vector[r].slope[0] == Approx(slope[r]).margin(2e-9));
      CHECK(local.torque(m)[c] == Approx(m.dot(slope)).margin(5e-9));
      // the torque has its slope too
      auto torque = [&](double s) {
        return LocalRotation<double>(lanes_of(rotation(s * Vector3d::Unit(c)) * q)).torque(m);
      };
      const Vector3d change = (torque(1e-5) - torque(-1e-5)) / 2e-5;
      const auto exact = dual.torque(Vec<Dual<double, 1>, 3>(m[0], m[1], m[2]));
      for (int r = 0; r < 3; ++r) CHECK(exact[r].slope[0] == Approx(change[r]).epsilon(1e-6).margin(1e-8));
    }
  }
}

}  // namespace test_corotation
