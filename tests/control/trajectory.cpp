// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/control/trajectory.hpp>

#include <numbers>

namespace test_trajectory {

using namespace sinew;
using Eigen::Vector3d;

namespace {

template <class D>
typename D::Coord at(Trajectory<D> const& t, double time) {
  typename D::VecCoord x(t.points, D::zero());
  t.place(time, x);
  return x[0];
}
template <class D>
typename D::Deriv rate(Trajectory<D> const& t, double time, bool arriving = false) {
  typename D::VecDeriv v(t.points, D::Deriv::Constant(7));
  t.move(time, arriving, v);
  return v[0];
}
/// (x(t + h) - x(t - h)) / 2h
template <class D>
typename D::Deriv difference(Trajectory<D> const& t, double time, double h = 1e-5) {
  return D::difference(at(t, time - h), at(t, time + h)) / (2 * h);
}
Quat<double> rotation(double angle, Vector3d const& axis) {
  return Quat<double>(Eigen::AngleAxisd(angle, axis.normalized()));
}

Trajectory<Vec3d> path(Interpolation interpolation, bool loop = false) {
  Trajectory<Vec3d> t{1, {1, 1.5, 3}, {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}, {}, interpolation, loop};
  t.prepare();
  return t;
}
Trajectory<Rigid3d> tumbling(Interpolation interpolation) {
  Trajectory<Rigid3d> t{1,
                        {0, 0.5, 2, 3},
                        {{{0, 0, 0}, rotation(0, {1, 0, 0})},
                         {{1, 0, 0}, rotation(1, {1, 2, 0})},
                         {{1, 2, 0}, rotation(2, {0, 1, 3})},
                         {{0, 2, 1}, rotation(1.5, {1, 0, 3})}},
                        {},
                        interpolation};
  t.prepare();
  return t;
}

}  // namespace

TEST_CASE("a linear trajectory goes straight from key to key, and rests outside of them") {
  const auto t = path(Interpolation::linear);
  CHECK(at(t, 0.3) == Vector3d(0, 0, 0));
  CHECK(at(t, 1.25) == Vector3d(0.5, 0, 0));
  CHECK((at(t, 2) - Vector3d(1, 1, 0)).norm() < 1e-15);
  CHECK(at(t, 9) == Vector3d(1, 3, 0));
  CHECK(rate(t, 0.3) == Vector3d(0, 0, 0));
  CHECK(rate(t, 1.25) == Vector3d(2, 0, 0));
  CHECK(rate(t, 2) == Vector3d(0, 2, 0));
  CHECK(rate(t, 9) == Vector3d(0, 0, 0));
  // at a key, of the movement before it or after it
  CHECK(rate(t, 1.5, true) == Vector3d(2, 0, 0));
  CHECK(rate(t, 1.5, false) == Vector3d(0, 2, 0));
  CHECK(rate(t, 1, true) == Vector3d(0, 0, 0));
  CHECK(rate(t, 1, false) == Vector3d(2, 0, 0));
  CHECK(rate(t, 3, true) == Vector3d(0, 2, 0));
  CHECK_FALSE(t.given(0.9));
  CHECK(t.given(3));
  CHECK_FALSE(t.goesOn(3));
}

TEST_CASE("keys are taken bit by bit") {
  for (const auto interpolation : {Interpolation::linear, Interpolation::cubic, Interpolation::none}) {
    const auto t = tumbling(interpolation);
    for (std::size_t k = 0; k < t.times.size(); ++k) CHECK(at(t, t.times[k]) == t.positions[k]);
  }
}

TEST_CASE("without interpolation a key stays until the next") {
  auto t = path(Interpolation::none);
  CHECK(at(t, 1.49) == Vector3d(0, 0, 0));
  CHECK(at(t, 2.9) == Vector3d(1, 0, 0));
  CHECK(rate(t, 2) == Vector3d(0, 0, 0));
  t.velocities = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  CHECK(rate(t, 2) == Vector3d(2, 0, 0));
  CHECK(rate(t, 3, true) == Vector3d(3, 0, 0));
}

TEST_CASE("velocities that are given are taken at the keys, and between them") {
  auto t = path(Interpolation::linear);
  t.velocities = {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}};
  for (const bool arriving : {true, false}) {
    CHECK(rate(t, 1, arriving) == Vector3d(1, 0, 0));
    CHECK(rate(t, 1.5, arriving) == Vector3d(2, 0, 0));
    CHECK(rate(t, 3, arriving) == Vector3d(4, 0, 0));
  }
  CHECK((rate(t, 2.25) - Vector3d(3, 0, 0)).norm() < 1e-15);
  CHECK(rate(t, 3.5) == Vector3d(0, 0, 0));
}

TEST_CASE("a loop starts again, with the time between first and last key as period") {
  const auto t = path(Interpolation::linear, true);
  CHECK((at(t, 3.25) - at(t, 1.25)).norm() < 1e-14);
  CHECK((at(t, 1.25 + 20) - at(t, 1.25)).norm() < 1e-14);
  CHECK((at(t, 0.25) - at(t, 2.25)).norm() < 1e-14);
  CHECK(at(t, 5) == Vector3d(0, 0, 0));
  CHECK(rate(t, 5, true) == Vector3d(0, 2, 0));
  CHECK(rate(t, 5, false) == Vector3d(2, 0, 0));
  CHECK(t.given(100));
  CHECK(t.goesOn(100));
}

TEST_CASE("orientations turn about one axis, on the shorter way, with constant angular velocity") {
  // from 0 to 1.2 rad about one axis, with a quaternion of the other sign at the end
  const Vector3d axis = Vector3d(1, 2, -1).normalized();
  Quat<double> end = rotation(1.2, axis);
  end.coeffs() = -end.coeffs();
  Trajectory<Rigid3d> t{1, {0, 2}, {{{0, 0, 0}, rotation(0, axis)}, {{2, 0, 0}, end}}};
  t.prepare();
  for (const double u : {0.1, 0.5, 0.9}) {
    const auto x = at(t, 2 * u);
    CHECK(x.orientation.angularDistance(rotation(1.2 * u, axis)) <
          1e-7);  // acos near 1 loses half of the digits
    CHECK((x.orientation * Vector3d(1, 0, 0) - rotation(1.2 * u, axis) * Vector3d(1, 0, 0)).norm() < 1e-15);
    const auto v = rate(t, 2 * u);
    CHECK((v.head<3>() - Vector3d(1, 0, 0)).norm() < 1e-15);
    CHECK((v.tail<3>() - 0.6 * axis).norm() < 1e-15);
  }
}

TEST_CASE("the velocity is the derivative of the position") {
  // central differences over 2e-5 s of movements of order 1: truncation 1e-10, rounding 1e-11
  for (const auto interpolation : {Interpolation::linear, Interpolation::cubic}) {
    const auto t = tumbling(interpolation);
    for (double time = 0.05; time < 3; time += 0.1) {
      INFO(time);
      CHECK((rate(t, time) - difference(t, time)).norm() < 1e-8);
    }
  }
  const auto t = path(Interpolation::cubic);
  for (double time = 1.05; time < 3; time += 0.1) CHECK((rate(t, time) - difference(t, time)).norm() < 1e-8);
}

TEST_CASE("a cubic trajectory has no jump in velocity, a linear one has") {
  const double h = 1e-9;
  auto jump = [&](auto const& t, double time) { return (rate(t, time + h) - rate(t, time - h)).norm(); };
  for (const double key : {0.5, 2.0}) {
    CHECK(jump(tumbling(Interpolation::cubic), key) < 1e-7);
    CHECK(jump(tumbling(Interpolation::linear), key) > 0.1);
  }
  // over the seam of a closed loop too
  Trajectory<Vec3d> ring{
      1, {0, 1, 2, 3.5}, {{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {1, 0, 0}}, {}, Interpolation::cubic, true};
  ring.prepare();
  CHECK(jump(ring, 3.5) < 1e-7);
}

TEST_CASE("a cubic trajectory through a parabola is the parabola") {
  // tangents of parabolas through three keys are exact for one; at the ends they are not, so inner keys only
  Trajectory<Vec1d> t;
  t.points = 1, t.interpolation = Interpolation::cubic;
  for (const double time : {0.0, 0.3, 1.0, 1.8, 2.0}) {
    t.times.push_back(time);
    t.positions.push_back(Vec1d::Coord(2 * time * time - time));
  }
  t.prepare();
  for (double time = 0.35; time < 1.8; time += 0.1) {
    CHECK(at(t, time)[0] == Approx(2 * time * time - time).margin(1e-14));
    CHECK(rate(t, time)[0] == Approx(4 * time - 1).margin(1e-13));
  }
}

TEST_CASE("cubic interpolation of orientations converges with the third order") {
  // a body that spins about a moving axis; keys twice as dense leave an error 8 times smaller (Catmull-Rom
  // tangents are of second order, so the positions are of third, away from the ends)
  auto exact = [](double t) { return rotation(std::sin(t), {0, 0, 1}) * rotation(2 * t, {1, 0, 0}); };
  auto error = [&](int keys) {
    Trajectory<Rigid3d> t;
    t.points = 1, t.interpolation = Interpolation::cubic;
    for (int k = 0; k <= keys; ++k) {
      t.times.push_back(2.0 * k / keys);
      t.positions.push_back({{0, 0, 0}, exact(t.times.back())});
    }
    t.prepare();
    double maximum = 0;
    for (double time = 0.5; time < 1.5; time += 0.013)
      maximum = std::max(maximum, Rigid3d::difference(at(t, time), {{0, 0, 0}, exact(time)}).norm());
    return maximum;
  };
  const double order = std::log2(error(16) / error(32));
  INFO(error(16) << " " << error(32));
  CHECK(order > 2.7);
}

TEST_CASE("one key is a place") {
  for (const auto interpolation : {Interpolation::linear, Interpolation::cubic, Interpolation::none})
    for (const bool loop : {false, true}) {
      Trajectory<Vec3d> t{1, {1}, {{1, 2, 3}}, {}, interpolation, loop};
      t.prepare();
      CHECK(at(t, 0) == Vector3d(1, 2, 3));
      CHECK(at(t, 1) == Vector3d(1, 2, 3));
      CHECK(rate(t, 1) == Vector3d(0, 0, 0));
      CHECK(t.given(1));
      CHECK_FALSE(t.given(2));
      CHECK_FALSE(t.goesOn(1));
    }
}

TEST_CASE("in the plane, and in single precision") {
  Trajectory<Rigid2d> t{1, {0, 1}, {{{0, 0}, 0}, {{1, 2}, 3}}};
  CHECK(at(t, 0.5).orientation == 1.5);
  CHECK(rate(t, 0.5) == Rigid2d::Deriv(1, 2, 3));
  Trajectory<Rigid3f> f{
      1, {0, 1}, {{{0, 0, 0}, Quat<float>(1, 0, 0, 0)}, {{1, 0, 0}, Quat<float>(0, 0, 0, 1)}}};
  f.interpolation = Interpolation::cubic;
  f.prepare();
  CHECK((at(f, 0.5).center - Eigen::Vector3f(0.5f, 0, 0)).norm() < 1e-6f);
}

}  // namespace test_trajectory
