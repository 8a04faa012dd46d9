// SPDX-License-Identifier: BSL-1.0
#include "moving_point.hpp"

#include <sinew/constraint/affine_movement.hpp>
#include <sinew/constraint/linear_movement.hpp>
#include <sinew/constraint/linear_velocity.hpp>
#include <sinew/constraint/oscillator.hpp>

#include <cmath>
#include <numbers>

namespace test_movements {

using namespace sinew;
using Eigen::Vector3d;
using moving::at;
using moving::elsewhere;
using moving::holds;
using moving::near;
using moving::two;
using one::ready;
using one::refuses;
using std::numbers::pi;

TEST_CASE("points move through key movements") {
  using Movement = LinearMovementConstraint<Vec3d>;
  Movement moved{.indices = {1}, .keyTimes = {1, 2, 4}, .movements = {{0, 0, 0}, {1, 0, 0}, {1, 0, 4}}};
  moved = ready(moved, two);
  CHECK_FALSE(holds(moved));  // before the first time it is free
  CHECK(at(moved, 0.5).first == elsewhere);
  CHECK_FALSE(holds(moved));
  CHECK(near(at(moved, 1).first, {1, 2, 3}));
  CHECK(holds(moved));
  CHECK(near(at(moved, 1.25).first, {1.25, 2, 3}));
  CHECK(near(at(moved, 1.25).second, {1, 0, 0}));
  CHECK(near(at(moved, 2).first, {2, 2, 3}));
  CHECK(near(at(moved, 3).first, {2, 2, 5}));
  CHECK(near(at(moved, 3).second, {0, 0, 2}));
  CHECK(holds(moved));
  CHECK(near(at(moved, 4).first, {2, 2, 7}));  // it arrives, and is free from then on
  CHECK_FALSE(holds(moved));
  CHECK(at(moved, 4.5).first == elsewhere);
  CHECK(at(moved, 4.5).second == elsewhere);

  moved.relativeMovements = false;
  moved = ready(moved, two);
  CHECK(near(at(moved, 3).first, {1, 0, 2}));
  moved.keyTimes = {0, 1, 2};
  CHECK(holds(ready(moved, two)));

  refuses(Movement{.indices = {2}}, two, {}, {"body", "LinearMovementConstraint<Vec3d>", "indices has 2"});
  refuses(Movement{.keyTimes = {}, .movements = {}}, two, {}, {"keyTimes is empty"});
  refuses(Movement{.keyTimes = {0, 1}}, two, {}, {"2 keyTimes and 1 movements"});
  refuses(Movement{.keyTimes = {1, 0}, .movements = {{0, 0, 0}, {0, 0, 0}}},
          two,
          {},
          {"keyTimes[1] is 0 s, not after keyTimes[0]"});
  refuses(Movement{.movements = {{0, one::notANumber, 0}}}, two, {}, {"movements[0] is nan"});
}

TEST_CASE("rigid bodies move and turn through key movements") {
  using Movement = LinearMovementConstraint<Rigid3d>;
  Rigid3d::VecCoord rest(1);
  rest[0].center = {1, 2, 3};
  rest[0].orientation = Eigen::AngleAxisd(pi / 2, Vector3d::UnitX());
  Rigid3d::VecDeriv movements(2, Rigid3d::Deriv::Zero());
  movements[1] << 2, 0, 0, 0, 0, 1;
  auto moved = ready(Movement{.keyTimes = {0, 2}, .movements = movements}, rest);
  Rigid3d::VecCoord x(1);
  Rigid3d::VecDeriv v(1);
  moved.projectPosition(1, x);
  moved.projectVelocity(1, v);
  CHECK(near(x[0].center, {2, 2, 3}));
  // half a radian about the z axis of the body, which is the world's -y
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.5, -Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(pi / 2, Vector3d::UnitX()));
  CHECK((x[0].orientation.coeffs() - expected.coeffs()).norm() < 1e-14);
  CHECK((v[0] - (Rigid3d::Deriv() << 1, 0, 0, 0, -0.5, 0).finished()).norm() < 1e-14);
  // three angles: about x first, then y, then z
  movements[1] << 0, 0, 0, 0.3, 0.4, 0.5;
  moved = ready(Movement{.keyTimes = {0, 2}, .movements = movements, .relativeMovements = false}, rest);
  moved.projectPosition(2, x);
  const Eigen::Quaterniond angles(Eigen::AngleAxisd(0.5, Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.4, Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.3, Vector3d::UnitX()));
  CHECK((x[0].orientation.coeffs() - angles.coeffs()).norm() < 1e-14);
  CHECK(x[0].center.norm() == 0);
}

TEST_CASE("points move to an affine image") {
  using Affine = AffineMovementConstraint<Vec3d>;
  Affine affine{.indices = {1}, .beginConstraintTime = 1, .endConstraintTime = 3, .translation = {10, 0, 0}};
  affine.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 2;
  affine = ready(affine, two);
  const Vector3d end(10 - 2, 1, 6), start(1, 2, 3);
  CHECK(at(affine, 0.5).first == elsewhere);
  CHECK(at(affine, 0.5).second.norm() == 0);
  CHECK(holds(affine));
  CHECK(near(at(affine, 1).first, start));
  CHECK(near(at(affine, 1.5).first, 0.75 * start + 0.25 * end));
  CHECK(near(at(affine, 1.5).second, 0.5 * (end - start)));
  CHECK(near(at(affine, 3).first, end));
  CHECK(near(at(affine, 30).first, end));
  CHECK(at(affine, 30).second.norm() == 0);

  Rigid3d::VecCoord body(1);
  body[0].center = {1, 0, 0};
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ()));
  auto turned =
      ready(AffineMovementConstraint<Rigid3d>{.indices = {0}, .quaternion = quarter.coeffs()}, body);
  turned.projectPosition(20, body);
  CHECK(near(body[0].center, {0, 1, 0}));
  CHECK((body[0].orientation.coeffs() - quarter.coeffs()).norm() < 1e-14);

  refuses(Affine{.indices = {2}}, two, {}, {"AffineMovementConstraint<Vec3d>", "indices has 2"});
  refuses(
      Affine{.beginConstraintTime = 20}, two, {}, {"beginConstraintTime is 20 s and endConstraintTime 20 s"});
  refuses(AffineMovementConstraint<Rigid3d>{.indices = {0}, .quaternion = {0, 0, 0, 0}},
          body,
          {},
          {"quaternion is zero"});
}

TEST_CASE("points move with key velocities") {
  using Velocity = LinearVelocityConstraint<Vec3d>;
  Velocity velocity{.indices = {1}, .keyTimes = {0, 2, 3}, .velocities = {{1, 0, 0}, {3, 0, 0}, {3, 4, 0}}};
  velocity = ready(velocity, two);
  CHECK(holds(velocity));
  // 1 + t until 2, then 3 with 4 (t - 2) across
  CHECK(near(at(velocity, 1).first, {1 + 1 + 0.5, 2, 3}));
  CHECK(near(at(velocity, 1).second, {2, 0, 0}));
  CHECK(near(at(velocity, 2.5).first, {1 + 4 + 1.5, 2 + 0.5, 3}));
  CHECK(near(at(velocity, 2.5).second, {3, 2, 0}));
  CHECK(near(at(velocity, 3).first, {1 + 4 + 3, 2 + 2, 3}));
  CHECK_FALSE(holds(velocity));
  CHECK(at(velocity, 4).first == elsewhere);
  velocity.continueAfterEnd = true;
  CHECK(near(at(velocity, 4).first, {1 + 4 + 6, 2 + 2 + 4, 3}));
  CHECK(near(at(velocity, 4).second, {3, 4, 0}));
  CHECK(holds(velocity));

  velocity.coordinates = {0};
  velocity = ready(velocity, two);
  CHECK(near(at(velocity, 1).first, {2.5, -8, -9}));
  CHECK(near(at(velocity, 1).second, {2, -8, -9}));
  Vec3d::VecDeriv dx(2, Vector3d(1, 2, 3));
  velocity.projectResponse(dx);
  CHECK(dx[1] == Vector3d(0, 2, 3));

  refuses(Velocity{.indices = {2}}, two, {}, {"LinearVelocityConstraint<Vec3d>", "indices has 2"});
  refuses(Velocity{.keyTimes = {0, 1}}, two, {}, {"2 keyTimes and 1 velocities"});
  refuses(Velocity{.coordinates = {3}}, two, {}, {"coordinates has 3", "a point has 3"});
}

TEST_CASE("points oscillate") {
  using Sine = OscillatorConstraint<Vec3d>;
  Sine sine{{{.index = 1, .mean = {1, 0, 0}, .amplitude = {0, 2, 0}, .pulsation = 3, .phase = 0.5}}};
  sine = ready(sine, two);
  CHECK(holds(sine));
  CHECK(near(at(sine, 0.7).first, {1, 2 * std::sin(2.6), 0}));
  CHECK(near(at(sine, 0.7).second, {0, 6 * std::cos(2.6), 0}));
  sine.oscillators[0].index = 2;
  refuses(sine, two, {}, {"OscillatorConstraint<Vec3d>", "oscillators[0] moves point 2", "2 points"});
  sine.oscillators[0].index = 1, sine.oscillators[0].phase = one::notANumber;
  refuses(sine, two, {}, {"oscillators[0].phase is nan"});
}

}  // namespace test_movements
