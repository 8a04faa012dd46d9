// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "lagrangian/bodies.hpp"

#include <sinew/lagrangian/constraint_sweeps.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace test_convex_step {

using namespace sinew;
using namespace rigid_bodies;
using Eigen::Vector3d;

constexpr ConvexStepSettings tight{.tolerance = 1e-11, .momentumTolerance = 1e-13};

TEST_CASE("a mass of 2 kg on a rail is stopped, held, or let go by a convex step") {
  auto f = [&](double free, ConstraintBlock const& block) {
    Bodies<1> p;
    p.mass = {Eigen::Matrix<double, 1, 1>(2)};
    p.free = Eigen::VectorXd::Constant(1, free);
    p.rows.add(0, 1);
    p.rows.endRow();
    p.blocks = {block};
    p.start = Eigen::VectorXd::Zero(1);
    const Solution s = solve(p, tight);
    CHECK(s.result.converged);
    CHECK(s.velocity[0] == Approx(free + s.multipliers[0] / 2).margin(1e-12));
    return s.multipliers[0];
  };
  const double zero = 1e-10;
  CHECK(f(-3, ConstraintBlock::equality(0, 1)) == Approx(6));
  CHECK(f(3, ConstraintBlock::equality(0, 1)) == Approx(-6));
  CHECK(f(-3, ConstraintBlock::unilateral(0)) == Approx(6));
  CHECK(f(3, ConstraintBlock::unilateral(0)) == 0);
  CHECK(f(3, ConstraintBlock::interval(0, -1, 2)) == Approx(-2));
  CHECK(f(-3, ConstraintBlock::interval(0, -1, 2)) == Approx(4));
  CHECK(std::abs(f(1, ConstraintBlock::interval(0, -1, 2))) < zero);
  CHECK(f(3, ConstraintBlock::interval(0, 1, 1)) == Approx(-4));
}

TEST_CASE("a block on an incline sticks below the angle of friction and slides with g (sin a - mu cos a)") {
  const double h = 0.01, g = 9.81, mu = 0.5;
  for (const FrictionLag lag : {FrictionLag::bound, FrictionLag::gap})
    for (const double angle : {0.2, 0.46, 0.47, 1.0}) {
      Bodies<3> p;
      p.mass = {2 * Eigen::Matrix3d::Identity()};
      // the plane is x = 0; v* after a step from rest
      p.free = h * g * Vector3d(-std::cos(angle), std::sin(angle), 0);
      p.contact({0}, {Eigen::Matrix3d::Identity()}, mu, 0);
      ConvexStepSettings settings = tight;
      settings.friction = lag;
      const Solution s = solve(p, settings);
      REQUIRE(s.result.converged);
      CHECK(std::abs(s.velocity[0]) < 1e-10);
      CHECK(s.velocity[1] ==
            Approx(h * std::max(0., g * (std::sin(angle) - mu * std::cos(angle)))).margin(1e-10));
      CHECK(s.multipliers[0] == Approx(2 * h * g * std::cos(angle)));
    }
}

TEST_CASE("without a lag what slides is lifted by mu times its velocity, as Anitescu has it") {
  Bodies<3> p;
  p.mass = {Eigen::Matrix3d::Identity()};
  p.free = Vector3d(-0.1, 1, 0);
  p.contact({0}, {Eigen::Matrix3d::Identity()}, 0.5, 0);
  ConvexStepSettings settings = tight;
  settings.friction = FrictionLag::none;
  const Solution s = solve(p, settings);
  // v = v* + f (1, -mu),  v_n = mu v_t:  f = (mu v*_t - v*_n) / (1 + mu^2)
  const double f = (0.5 * 1 + 0.1) / 1.25;
  CHECK(s.result.converged);
  CHECK(s.velocity[0] == Approx(0.5 * s.velocity[1]));
  CHECK(s.multipliers[0] == Approx(f));
  CHECK(s.multipliers[1] == Approx(-0.5 * f));
}

TEST_CASE("an impact of two balls conserves momentum and takes energy") {
  Bodies<3> p;
  p.mass = {3 * Eigen::Matrix3d::Identity(), 1 * Eigen::Matrix3d::Identity()};
  p.free.resize(6);
  p.free << 1, 0.2, 0, -2, -0.3, 0.1;
  p.contact({0, 1}, {-Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()}, 0.3, 0);
  const Solution s = solve(p, tight);
  REQUIRE(s.result.converged);
  const Vector3d before = 3 * p.free.head<3>() + p.free.tail<3>(),
                 after = 3 * s.velocity.head<3>() + s.velocity.tail<3>();
  CHECK((before - after).norm() < 1e-12);
  // inelastic along the line of centres: both have the velocity (3 - 2) / 4
  CHECK(s.velocity[0] == Approx(0.25));
  CHECK(s.velocity[3] == Approx(0.25));
  CHECK(p.energy(s.velocity) < p.energy(p.free));
}

TEST_CASE("a ball with sliding velocity rolls without slip after the step, with 5/7 of it") {
  // one impulse is enough where mu is large: m v + I w / r is conserved about the point of contact
  const double m = 2, r = 0.3, v0 = 1.5;
  Bodies<6> p;
  Eigen::Matrix<double, 6, 1> mass;
  mass << m, m, m, Vector3d::Constant(0.4 * m * r * r);
  p.mass = {Eigen::Matrix<double, 6, 6>(mass.asDiagonal())};
  p.free.setZero(6);
  p.free[0] = v0;
  p.free[2] = -1;
  contact_at(p, -1, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, r}, Vector3d::UnitZ(), 2, 0);
  const Solution s = solve(p, tight);
  REQUIRE(s.result.converged);
  CHECK(s.velocity[0] == Approx(v0 * 5 / 7));
  CHECK(s.velocity[4] == Approx(v0 * 5 / 7 / r));
  CHECK(std::abs(s.velocity[2]) < 1e-10);
}

TEST_CASE("gaps at the start may be closed, and no more") {
  Bodies<3> p;
  p.mass = {Eigen::Matrix3d::Identity()};
  p.free = Vector3d(-3, 0, 0);
  p.contact({0}, {Eigen::Matrix3d::Identity()}, 0.5, 2);
  const Solution s = solve(p, tight);
  CHECK(s.velocity[0] == Approx(-2));
  CHECK(s.multipliers[0] == Approx(1));
}

TEST_CASE("equalities hold to 1e-10, those of a chain of rods too") {
  // masses on a chain whose links keep their lengths: J J' is the second difference
  Bodies<3> p;
  const int n = 40;
  p.free.resize(3 * n);
  for (int i = 0; i < n; ++i) {
    p.mass.push_back((1 + 0.1 * (i % 3)) * Eigen::Matrix3d::Identity());
    p.free.segment<3>(3 * i) << std::sin(0.7 * i), std::cos(1.3 * i), -0.1 * i;
  }
  for (int i = 0; i + 1 < n; ++i) {
    const Vector3d u = Vector3d(std::cos(0.2 * i), std::sin(0.2 * i), 0.3).normalized();
    for (int k = 0; k < 3; ++k) {
      p.rows.add(3 * i + k, -u[k]);
      p.rows.add(3 * i + 3 + k, u[k]);
    }
    p.rows.endRow();
    p.blocks.push_back(ConstraintBlock::equality(i, 1));
  }
  p.start = Eigen::VectorXd::Zero(n - 1);
  const Solution s = solve(p, {.tolerance = 1e-10, .momentumTolerance = 1e-12});
  REQUIRE(s.result.converged);
  Eigen::VectorXd d;
  p.rows.multiply(s.velocity, d);
  CHECK(d.lpNorm<Eigen::Infinity>() < 1e-10);
  // Gauss's principle: the least change in the metric of the mass
  const Eigen::MatrixXd J = p.jacobian(), M = p.massMatrix();
  const Eigen::VectorXd exact =
      p.free - M.inverse() * J.transpose() * (J * M.inverse() * J.transpose()).ldlt().solve(J * p.free);
  CHECK((s.velocity - exact).norm() < 1e-8);
}

TEST_CASE("the multipliers of contacts with friction are those of Gauss-Seidel, with either lag") {
  for (unsigned seed = 1; seed <= 10; ++seed)
    for (const FrictionLag lag : {FrictionLag::bound, FrictionLag::gap}) {
      const Bodies<3> p = tree_of_points(12, 0.3, seed);
      ConstraintProblem q = p.problem();
      ConstraintSweeps sweeps;
      REQUIRE(
          sweeps
              .gaussSeidel(q, {.maxIterations = 100000, .tolerance = 1e-13, .scaleTolerance = false}, "test")
              .converged);
      ConvexStepSettings settings{.tolerance = 1e-9, .momentumTolerance = 1e-11};
      settings.friction = lag;
      settings.maxUpdates = 200;
      const Solution s = solve(p, settings);
      CAPTURE(seed, int(lag), s.result.residual, s.result.updates);
      REQUIRE(s.result.converged);
      ConstraintProblem mine = q;
      mine.multipliers = s.multipliers;
      // A is block-diagonal here: the estimate of the diagonal of W is exact
      CHECK(mine.residual() < 2e-9);
      CHECK(mine.residual() == Approx(s.result.residual).margin(1e-10));
      // errors of velocities are those of residuals by the condition of W, below 100
      CHECK((s.velocity - (p.free + p.massMatrix().inverse() * p.jacobian().transpose() * q.multipliers))
                .norm() < 1e-7);
      CHECK((s.multipliers - q.multipliers).norm() < 1e-7);
    }
}

TEST_CASE("a wall of bricks stands, whatever multipliers hold it, and more guesses do not move it") {
  const Bodies<6> p = wall(10, 4, 0.6);
  Solution s = solve(p, {.tolerance = 1e-7, .momentumTolerance = 1e-8});
  REQUIRE(s.result.converged);
  CHECK(s.velocity.lpNorm<Eigen::Infinity>() < 1e-4);
  // the ground carries all of it
  double weight = 0, carried = 0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) weight -= p.mass[i](0, 0) * p.free[6 * Eigen::Index(i) + 2];
  for (int i = 0; i < 4 * 4; ++i) carried += s.multipliers[3 * i];
  CHECK(carried == Approx(weight).epsilon(1e-4));
  // warm: the solution is its own next guess
  const int cold = s.result.conjugateGradients;
  ConvexStep step;
  const ConvexStepResult again = solve(step, p, s, {.tolerance = 1e-7, .momentumTolerance = 1e-8});
  CHECK(again.converged);
  CHECK(10 * again.conjugateGradients < cold);
}

TEST_CASE("energy never grows by contacts without a gap") {
  for (const double mu : {0., 0.3, 1.}) {
    const Bodies<6> p = wall(4, 3, mu, 0.5);
    const Solution s = solve(p, {.tolerance = 1e-6, .momentumTolerance = 1e-9});
    CHECK(p.energy(s.velocity) <= p.energy(p.free));
  }
}

TEST_CASE("rods whose ends strike and slide, as Painleve's, come to a rest or a slide that obeys Coulomb") {
  for (const double angle : {0.3, 0.8, 1.2})
    for (const double mu : {0.3, 1., 2.})
      for (const double slip : {-1., 1.}) {
        const Bodies<6> p = rod(angle, mu, slip);
        const Solution s = solve(p, {.tolerance = 1e-8, .momentumTolerance = 1e-10, .maxUpdates = 200});
        CAPTURE(angle, mu, slip, s.result.residual, s.result.updates);
        CHECK(s.result.converged);
        ConstraintProblem q = p.problem();
        q.multipliers = s.multipliers;
        CHECK(q.residual() < 1e-7);
        CHECK(p.energy(s.velocity) <= p.energy(p.free) * (1 + 1e-9));
      }
}

TEST_CASE("one object solves one problem after another, with the bits that a new one finds") {
  ConvexStep step;
  for (const int contacts : {3, 20, 7, 0, 12}) {
    const Bodies<3> p = tree_of_points(contacts, 0.4, 5);
    Solution one = p.cold(), other = p.cold();
    ConvexStep fresh;
    const ConvexStepResult a = solve(step, p, one, {}), b = solve(fresh, p, other, {});
    CHECK(one.velocity == other.velocity);
    CHECK(one.multipliers == other.multipliers);
    CHECK(a.conjugateGradients == b.conjugateGradients);
  }
}

TEST_CASE("a step without constraints is the free motion") {
  Bodies<3> p = tree_of_points(0, 0.4, 1);
  p.free = Vector3d(1, -2, 3);
  const Solution s = solve(p, tight);
  CHECK(s.result.converged);
  CHECK((s.velocity - p.free).norm() < 1e-12);
}

TEST_CASE("contradictory equalities leave finite velocities, and say what is left") {
  Bodies<1> p;
  p.mass = {Eigen::Matrix<double, 1, 1>(2)};
  p.free = Eigen::VectorXd::Zero(1);
  for (int i = 0; i < 2; ++i) {
    p.rows.add(0, 1);
    p.rows.endRow();
    p.blocks.push_back(ConstraintBlock::equality(i, 1));
  }
  p.start = Eigen::Vector2d(-1, 1);  // v = 1 and v = -1
  const Solution s = solve(p, {});
  CHECK_FALSE(s.result.converged);
  CHECK(s.result.residual == Approx(1).epsilon(1e-3));
  CHECK(std::abs(s.velocity[0]) < 1e-6);  // between them
  CHECK(s.multipliers.allFinite());

  p.start = Eigen::Vector2d(-1, -1);  // the same twice
  const Solution t = solve(p, {});
  CHECK(t.result.converged);
  CHECK(t.velocity[0] == Approx(1));
  CHECK(t.multipliers.sum() == Approx(2));
}

TEST_CASE("friction without bounds holds, and without any lets go") {
  for (const double mu : {0., 1e6, 1e300}) {
    Bodies<3> p;
    p.mass = {Eigen::Matrix3d::Identity()};
    p.free = Vector3d(-0.1, 1, 0);
    p.contact({0}, {Eigen::Matrix3d::Identity()}, mu, 0);
    const Solution s = solve(p, {});
    CHECK(s.result.converged);
    CHECK(std::abs(s.velocity[0]) < 1e-5);
    CHECK(s.velocity[1] == Approx(mu > 0 ? 0 : 1).margin(1e-5));
  }
}

TEST_CASE("steps that cannot be solved are refused, with what is wrong") {
  const Bodies<3> good = tree_of_points(2, 0.4, 1);
  auto says = [&](auto&& spoil) {
    Bodies<3> p = good;
    Solution s = p.cold();
    spoil(p, s);
    ConvexStep step;
    return error_of([&] { solve(step, p, s, {}); });
  };
  using Catch::Contains;
  const double nan = std::nan("");
  CHECK(says([](Bodies<3>&, Solution&) {}).empty());
  CHECK_THAT(says([](Bodies<3>&, Solution& s) { s.velocity.resize(4); }),
             Contains("9 dofs has 4 velocities"));
  CHECK_THAT(says([](Bodies<3>&, Solution& s) { s.multipliers.resize(4); }),
             Contains("6 rows, 6 violations and 4 multipliers"));
  CHECK_THAT(says([&](Bodies<3>& p, Solution&) { p.start[1] = nan; }), Contains("not a finite number"));
  CHECK_THAT(says([&](Bodies<3>& p, Solution&) { p.rows.values[2] = nan; }),
             Contains("row 0 of the constraints is not a finite number"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.rows.dofs[0] = 9; }), Contains("dof 9 of 9"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.rows.first.back() = 3; }), Contains("end at entry 3"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.rows.first[1] = 100; }),
             Contains("row 1 of the constraints ends before"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.blocks[1].friction = -1; }), Contains("friction -1"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.blocks.pop_back(); }), Contains("cover 3 rows of 6"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { std::fill(p.rows.values.begin(), p.rows.values.end(), 0.); }),
             Contains("nothing that constraint 0 holds can move"));
  CHECK_THAT(says([](Bodies<3>& p, Solution&) { p.mass.pop_back(), p.mass.shrink_to_fit(); }),
             Contains("preconditioner of 6"));
  CHECK_THAT(
      says([&](Bodies<3>& p, Solution&) { p.mass[0](0, 0) = std::numeric_limits<double>::infinity(); }),
      Contains("not finite") || Contains("not a finite number"));
}

TEST_CASE("settings out of their range are refused") {
  const Bodies<3> p = tree_of_points(2, 0.4, 1);
  auto says = [&](ConvexStepSettings const& settings) { return error_of([&] { solve(p, settings); }); };
  using Catch::Contains;
  CHECK_THAT(says({.regularisation = 0}), Contains("positive number"));
  CHECK_THAT(says({.firstRegularisation = std::nan("")}), Contains("positive number"));
  CHECK_THAT(says({.forcing = 1}), Contains("between 0 and 1"));
  CHECK_THAT(says({.tolerance = -1}), Contains("negative"));
}

TEST_CASE("a step with fewer rows follows one with more in which nothing touches") {
  Bodies<3> apart = tree_of_points(20, 0.4, 5), touching = tree_of_points(6, 0.4, 6);
  for (int c = 0; c < 20; ++c) apart.start[3 * c] = 1;
  ConvexStep step;
  Solution none = apart.cold(), after = touching.cold();
  CHECK(solve(step, apart, none, {}).newtonIterations == 0);
  solve(step, touching, after, {});
  const Solution alone = solve(touching, {});
  CHECK(after.velocity == alone.velocity);
  CHECK(after.multipliers == alone.multipliers);
}

TEST_CASE("a system that is not positive definite ends without a crash, and is not called solved") {
  Bodies<3> p = tree_of_points(2, 0.4, 1);
  for (Eigen::Matrix3d& m : p.mass) m = -m;
  Solution s = p.cold();
  s.velocity.setOnes();
  ConvexStep step;
  const ConvexStepResult result = solve(step, p, s, {.maxUpdates = 3});
  CHECK_FALSE(result.converged);
  CHECK(s.velocity.allFinite());
}

}  // namespace test_convex_step
