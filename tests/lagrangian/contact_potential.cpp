// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/lagrangian/constraint_terms.hpp>

#include <Eigen/Eigenvalues>
#include <random>

namespace test_contact_potential {

using namespace sinew;
namespace cp = contact_potential;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Sample {
  Vector3d r, g, d;
  double mu, bound;
  cp::Rows rows(bool bounded) const { return {r.data(), g.data(), bounded ? bound : cp::cone}; }
};
Sample sample(std::mt19937& random) {
  std::uniform_real_distribution<double> at(-1, 1), positive(0.2, 2);
  Sample s;
  s.r[0] = positive(random);
  s.r[1] = s.r[2] = positive(random);
  for (int i = 0; i < 3; ++i) s.g[i] = at(random), s.d[i] = at(random);
  s.mu = positive(random);
  s.bound = 0.5 * positive(random);
  return s;
}

// Central differences of step e have an error of e^2 of the third derivative and of rounding over e, 1e-10
// and 1e-11 here; at a kink between regions, which a sample may hit, differences are of no use.
TEST_CASE("multipliers are minus the gradient of the potential, and the curvature is that of its gradient") {
  std::mt19937 random(1);
  const double e = 1e-5;
  const ConstraintBlock contact = ConstraintBlock::contact(0, 0),
                        box = ConstraintBlock::interval(0, -0.2, 0.3),
                        equality = ConstraintBlock::equality(0, 3);
  int regions[3] = {0, 0, 0}, outside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Sample s = sample(random);
    ConstraintBlock block = trial % 4 == 2 ? box : trial % 4 == 3 ? equality : contact;
    block.friction = s.mu;
    const cp::Rows rows = s.rows(trial % 4 == 1);
    Vector3d f(0, 0, 0);
    cp::multipliers(block, rows, s.d.data(), f.data());
    double stored[3 * ConstraintBlock::maxRows] = {};
    cp::curvature(block, rows, s.d.data(), stored);
    if (block.kind == ConstraintBlock::Kind::friction)
      ++regions[int(cp::project(s.mu, s.r, rows.y(s.d.data())).region)];
    else if (block.kind == ConstraintBlock::Kind::interval && f[0] != 0)
      ++outside;
    bool smooth = true;
    Matrix3d G = Matrix3d::Zero(), difference = Matrix3d::Zero();
    Vector3d gradient(0, 0, 0);
    for (int i = 0; i < block.rows; ++i) {
      Vector3d w = Vector3d::Unit(i), low = s.d, high = s.d, below(0, 0, 0), above(0, 0, 0);
      cp::multiply(block, stored, w.data());
      G.col(i).head(block.rows) = w.head(block.rows);
      low[i] -= e, high[i] += e;
      gradient[i] = (cp::value(block, rows, high.data()) - cp::value(block, rows, low.data())) / (2 * e);
      cp::multipliers(block, rows, low.data(), below.data());
      cp::multipliers(block, rows, high.data(), above.data());
      difference.col(i) = (below - above) / (2 * e);
      double one[3 * ConstraintBlock::maxRows] = {}, other[3 * ConstraintBlock::maxRows] = {};
      cp::curvature(block, rows, low.data(), one);
      cp::curvature(block, rows, high.data(), other);
      for (int k = 0; k < 9; ++k) smooth = smooth && std::abs(one[k] - other[k]) < 0.01;
    }
    CAPTURE(trial, int(block.kind));
    CHECK((gradient + f).norm() < (smooth ? 1e-8 : 1e-3));
    CHECK(G == G.transpose());
    CHECK(Eigen::SelfAdjointEigenSolver<Matrix3d>(G).eigenvalues()[0] > -1e-12);
    if (smooth) CHECK((difference - G).norm() < 1e-7);
  }
  for (const int count : regions) CHECK(count > 100);
  CHECK(outside > 100);
}

TEST_CASE("the projection on the cone is the nearest point in the metric") {
  std::mt19937 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Sample s = sample(random);
    const Vector3d y = 2 * s.g, f = cp::project(s.mu, s.r, y).f;
    CHECK(f.tail<2>().norm() <= s.mu * f[0] + 1e-14);
    // no point of the cone is on the other side of the plane through f: (y - f)' r (z - f) <= 0
    const Vector3d normal = s.r.cwiseProduct(y - f);
    CHECK(std::abs(normal.dot(f)) < 1e-13);
    for (double angle = 0; angle < 6.3; angle += 0.1)
      CHECK(normal.dot(Vector3d(1, s.mu * std::cos(angle), s.mu * std::sin(angle))) < 1e-13);
    // in the metric of one r it is project_on_cone
    CHECK((cp::project(s.mu, Vector3d::Constant(s.r[0]), y).f - project_on_cone(y, s.mu)).norm() < 1e-14);
  }
}

TEST_CASE("the potential is continuous across the borders of its regions, with its gradient") {
  const ConstraintBlock block = ConstraintBlock::contact(0, 0.7);
  const Vector3d r(0.5, 0.8, 0.8), g(0, 0, 0);
  for (const double bound : {cp::cone, 0.4}) {
    const cp::Rows rows{r.data(), g.data(), bound};
    Vector3d last(0, 0, 0);
    double lastValue = 0;
    for (int i = 0; i <= 20000; ++i) {  // once around the origin
      const double angle = 2 * M_PI * i / 20000;
      const Vector3d d(std::cos(angle), 0.8 * std::sin(angle), 0.6 * std::sin(angle));
      Vector3d f;
      cp::multipliers(block, rows, d.data(), f.data());
      const double value = cp::value(block, rows, d.data());
      // |df| <= |dd| / r
      if (i > 0) {
        CHECK((f - last).norm() <= 2 * M_PI / 20000 / 0.5 * (1 + 1e-9));
        CHECK(std::abs(value - lastValue) < 2 * M_PI / 20000 * 4);
      }
      last = f;
      lastValue = value;
    }
  }
}

TEST_CASE("friction of zero, or beyond all bounds, leaves finite multipliers and curvatures") {
  std::mt19937 random(3);
  for (const double mu : {0., 1e8, 1e100, 1e300})
    for (int trial = 0; trial < 100; ++trial) {
      const Sample s = sample(random);
      const ConstraintBlock block = ConstraintBlock::contact(0, mu);
      const cp::Rows rows = s.rows(false);
      Vector3d f;
      Matrix3d G;
      cp::multipliers(block, rows, s.d.data(), f.data());
      cp::curvature(block, rows, s.d.data(), G.data());
      CHECK(f.allFinite());
      CHECK(G.allFinite());
      if (mu == 0) CHECK(f.tail<2>().norm() == 0);
      if (mu >= 1e8 && rows.y(s.d.data())[0] > 0) CHECK(f == rows.y(s.d.data()));  // it sticks
    }
}

}  // namespace test_contact_potential
