// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/penalty_contact.hpp>
#include <sinew/collision/stick_contact.hpp>

#include <random>

#include "catch.hpp"

namespace test_contact_laws {

using namespace sinew;

namespace {

Contact contact() {
  Contact c;
  c.normal = Eigen::Vector3d(0.36, 0.48, 0.8);
  c.thickness = 0.3;
  c.limit = 0.1;
  c.stiffness = 200;
  c.damping = 3;
  c.friction = 0.4;
  c.distance = 0.05;
  c.frictionState.slip = Eigen::Vector3d(0.004, -0.003, 0);
  c.start = 0.35 * c.normal;
  return c;
}

// force of a law at a displacement and a rate
template <class Law>
Eigen::Vector3d force(Law const& law, Contact c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate) {
  law.evaluate(c, u, rate);
  return c.evaluated;
}

// -dF/du and -dF/du' by central differences of step e: wrong by e^2 F'''/6 and rounding eps F/e
template <class Law>
void check_tangents(Law const& law, Contact const& c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate,
                    double slack) {
  Contact at = c;
  law.evaluate(at, u, rate);
  const double e = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = Eigen::Vector3d::Unit(k) * e;
    const Eigen::Vector3d du = (force(law, c, u - d, rate) - force(law, c, u + d, rate)) / (2 * e);
    const Eigen::Vector3d dr = (force(law, c, u, rate - d) - force(law, c, u, rate + d)) / (2 * e);
    CHECK((du - at.stiffnessMatrix.col(k)).norm() < slack);
    CHECK((dr - at.dampingMatrix.col(k)).norm() < slack);
  }
}

}  // namespace

TEST_CASE("the tangents of a penalty contact that sticks are those of its force") {
  const PenalityContactForceField law;
  check_tangents(law, contact(), contact().start, {0.1, 0, -0.2}, 1e-6);
}

TEST_CASE("the tangents of sticking are those of its force") {
  check_tangents(StickContactForceField{}, contact(), contact().start, {0.1, 0.3, -0.2}, 1e-6);
}

TEST_CASE("a contact that slides: the tangent across the motion is exact, and the force is on the cone") {
  const PenalityContactForceField law;
  Contact c = contact();
  c.frictionState.slip = 0.2 * c.normal.cross(Eigen::Vector3d::UnitX()).normalized();
  law.evaluate(c, c.start, {0, 0, 0});
  const double normal = c.evaluated.dot(c.normal);
  const Eigen::Vector3d tangential = c.evaluated - normal * c.normal;
  CHECK(normal == Approx(200 * 0.05).epsilon(1e-12));
  CHECK(tangential.norm() == Approx(0.4 * normal).epsilon(1e-12));
  CHECK(tangential.dot(c.frictionState.slip) < 0);
  const Eigen::Vector3d across = c.normal.cross(tangential.normalized());
  const double e = 1e-6;
  const Eigen::Vector3d du =
      (force(law, c, c.start - e * across, {0, 0, 0}) - force(law, c, c.start + e * across, {0, 0, 0})) /
      (2 * e);
  CHECK((du - c.stiffnessMatrix * across).norm() < 1e-6);
  CHECK((c.stiffnessMatrix - c.stiffnessMatrix.transpose()).norm() < 1e-12);
}

TEST_CASE("friction does work against the motion only, however a contact is moved about") {
  // random walk of u with the gap below the limit; the work of the friction force over a closed memory
  std::mt19937 random(5);
  std::uniform_real_distribution<double> step(-0.01, 0.01);
  const PenalityContactForceField law;
  Contact c = contact();
  c.damping = 0;
  c.frictionState.slip.setZero();
  Eigen::Vector3d u = c.start;
  double work = 0;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3d d(step(random), step(random), step(random));
    d -= c.normal.dot(d) * c.normal;
    const Eigen::Vector3d before = force(law, c, u, {0, 0, 0});
    u += d;
    law.settle(c, u);
    c.start = u;
    // trapezoidal: the spring's part is exact, on the cone the force turns by an angle of the order of
    // step/slip
    work += (0.5 * (before + force(law, c, u, {0, 0, 0}))).dot(d);
  }
  // what the spring holds at the end has been taken from the motion and may come back: k s^2 / 2
  const double maximum = 0.4 * 200 * 0.05 / 200;
  CHECK(work < 0.5 * 200 * maximum * maximum);
  CHECK(work < -1);
}

TEST_CASE("contacts push and never pull") {
  const PenalityContactForceField law;
  Contact c = contact();
  law.evaluate(c, 0.45 * c.normal, {0, 0, 0});  // gap 0.15
  CHECK(c.evaluated.norm() == 0);
  CHECK(c.stiffnessMatrix.norm() == 0);
  law.evaluate(c, 0.35 * c.normal, 10 * c.normal);  // leaves so fast that damping would pull
  CHECK(c.evaluated.dot(c.normal) >= 0);
  PenalityContactForceField ahead;
  ahead.dt = 0.01;
  c.implicit = true;
  law.evaluate(c, 0.45 * c.normal, -1 * c.normal);
  CHECK(c.evaluated.norm() == 0);  // 0.14 at the end of a step of 0 s
  ahead.evaluate(c, 0.45 * c.normal, -8 * c.normal);
  CHECK(c.normal.dot(c.stiffnessMatrix * c.normal) == Approx(200));  // will touch within the step
}

}  // namespace test_contact_laws
