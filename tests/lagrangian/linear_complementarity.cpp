// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/linear_complementarity.hpp>

namespace test_linear_complementarity {

using namespace sinew;
using namespace friction_problems;

// w = M z + q: neither is negative, and of each pair one is zero
double broken(Eigen::MatrixXd const& M, Eigen::VectorXd const& q, Eigen::VectorXd const& z) {
  return z.cwiseMin(M * z + q).cwiseAbs().maxCoeff();
}
Eigen::MatrixXd random_matrix(Random& random, int rows, int columns) {
  Eigen::MatrixXd J(rows, columns);
  for (double& entry : J.reshaped()) entry = random.between(-1, 1);
  return J;
}
// the normals of contacts as blocks of a row
ConstraintProblem unilateral(Eigen::MatrixXd const& M, Eigen::VectorXd const& q) {
  ConstraintProblem p{M, q, Eigen::VectorXd::Zero(q.size()), {}};
  for (int i = 0; i < q.size(); ++i) p.blocks.push_back(ConstraintBlock::unilateral(i));
  return p;
}
constexpr ComplementaritySettings exact{.maxIterations = 100000, .tolerance = 1e-12};

TEST_CASE("Lemke's method: problems solved by hand") {
  Lemke lemke;
  ReservedVector z;
  // Murty's example: z = (2, 0, 1) / ..., by complementarity from its active rows
  const Eigen::MatrixXd M{{2, 1}, {1, 2}};
  REQUIRE(lemke.solve(M, Eigen::Vector2d(-5, -6), z, 100) == Lemke::End::solved);
  CHECK(z[0] == Approx(4. / 3));
  CHECK(z[1] == Approx(7. / 3));
  REQUIRE(lemke.solve(M, Eigen::Vector2d(-5, 6), z, 100) == Lemke::End::solved);
  CHECK(z[0] == Approx(2.5));
  CHECK(z[1] == 0);
  REQUIRE(lemke.solve(M, Eigen::Vector2d(0, 6), z, 100) == Lemke::End::solved);
  CHECK(lemke.pivots == 0);
  CHECK(z.isZero());
  // not symmetric: w = z turned by a right angle + q
  const Eigen::MatrixXd turned{{0, 1}, {-1, 0}};
  REQUIRE(lemke.solve(turned, Eigen::Vector2d(-1, 2), z, 100) == Lemke::End::solved);
  CHECK(broken(turned, Eigen::Vector2d(-1, 2), z) < 1e-14);
}

TEST_CASE("Lemke's method ends on a ray where there is no solution") {
  Lemke lemke;
  ReservedVector z;
  // one multiplier pushes apart what the other pushes together, and both are to grow
  const Eigen::MatrixXd M{{1, -1}, {-1, 1}};
  CHECK(lemke.solve(M, Eigen::Vector2d(-1, -1), z, 100) == Lemke::End::ray);
  CHECK(z.isZero());
  CHECK(lemke.solve(M, Eigen::Vector2d(-1, 1), z, 100) == Lemke::End::solved);
  CHECK(lemke.solve(M, Eigen::Vector2d(-1, 0.5), z, 100) == Lemke::End::ray);
  CHECK(lemke.solve(Eigen::Matrix2d::Identity(), Eigen::Vector2d(-1, -1), z, 1) == Lemke::End::pivotsEnded);
}

TEST_CASE("Lemke's method: random contacts, with more of them than motions") {
  Lemke lemke;
  int pivots = 0, rows = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const int n = 5 + int(seed), motions = seed % 3 == 0 ? n : seed % 3 == 1 ? n / 2 + 1 : 3 * n;
    Eigen::MatrixXd J = random_matrix(random, n, motions);
    if (seed % 4 == 0) J.bottomRows(n / 2) = J.topRows(n / 2);  // each twice
    const double unit = std::pow(10., random.between(-8, 4));
    const Eigen::MatrixXd M = unit * J * J.transpose();
    // J v + J dv can be made positive: that there is such a motion makes the problem solvable
    const Eigen::VectorXd q = -J * J.transpose() * Eigen::VectorXd::Ones(n).cwiseAbs() * unit;
    const Eigen::VectorXd free =
        q + unit * Eigen::VectorXd::NullaryExpr(n, [&] { return random.between(0, 3); });
    ReservedVector z;
    CAPTURE(seed, n);
    REQUIRE(lemke.solve(M, free, z, 50 * n) == Lemke::End::solved);
    // rounding times the condition of a basis
    CHECK(broken(M, free, z) < 1e-9 * free.cwiseAbs().maxCoeff());
    CHECK(z.minCoeff() >= 0);
    pivots += lemke.pivots;
    rows += n;
  }
  CHECK(pivots < 4 * rows);
}

TEST_CASE("Lemke's method does not cycle where all bases are degenerate") {
  // a table on 40 legs that are all alike: the load is carried, however it is shared
  const int n = 40;
  const Eigen::MatrixXd M = Eigen::MatrixXd::Ones(n, n);
  Lemke lemke;
  ReservedVector z;
  REQUIRE(lemke.solve(M, Eigen::VectorXd::Constant(n, -2), z, 50 * n) == Lemke::End::solved);
  CHECK(z.sum() == Approx(2));
  // with corners: four legs under a square plate, of which three would do
  for (const double x : {0., 0.3, -0.5}) {
    Eigen::MatrixXd J(4, 3);
    J << 1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1;
    const Eigen::Vector3d load(1, x, x);  // its centre of mass
    const Eigen::VectorXd q = -J * load;
    REQUIRE(lemke.solve(J * J.transpose(), q, z, 100) == Lemke::End::solved);
    CHECK((J.transpose() * z - load).norm() < 1e-12);
  }
}

TEST_CASE("Lemke and Gauss-Seidel find the same forces, SOFA's and by conjugate gradients too") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Eigen::MatrixXd J = random_matrix(random, 15, 40);
    ConstraintProblem p = unilateral(
        J * J.transpose(), Eigen::VectorXd::NullaryExpr(15, [&] { return random.between(-1, 0.5); }));
    ConstraintProblem a = p, b = p, c = p;
    REQUIRE(LinearComplementarity().solve(a, "test").converged);
    REQUIRE(ComplementaritySweeps().solve(b, exact, "test").converged);
    REQUIRE(ConstraintSweeps()
                .nonsmoothConjugateGradients(c, {.maxIterations = 10000, .tolerance = 1e-12}, "test")
                .converged);
    CHECK(a.residual() < 1e-12);
    CHECK((a.multipliers - b.multipliers).norm() < 1e-9 * a.multipliers.norm());
    CHECK((a.multipliers - c.multipliers).norm() < 1e-9 * a.multipliers.norm());
  }
}

TEST_CASE("equalities are eliminated, intervals have two ends, contacts may be without friction") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Eigen::MatrixXd J = random_matrix(random, 16, 30);
    ConstraintProblem p{J * J.transpose(),
                        Eigen::VectorXd::NullaryExpr(16, [&] { return random.between(-1, 1); }),
                        Eigen::VectorXd::Zero(16),
                        {ConstraintBlock::equality(0, 3),
                         ConstraintBlock::contact(3, 0),
                         ConstraintBlock::interval(6, -0.2, 0.2),
                         ConstraintBlock::interval(7, 0.1, 0.1),
                         ConstraintBlock::unilateral(8),
                         ConstraintBlock::interval(9, -std::numeric_limits<double>::infinity(), 0.1),
                         ConstraintBlock::equality(10, 3),
                         ConstraintBlock::contact(13, 0)}};
    ConstraintProblem a = p, b = p;
    REQUIRE(LinearComplementarity().solve(a, "test").converged);
    REQUIRE(
        ConstraintSweeps().gaussSeidel(b, {.maxIterations = 100000, .tolerance = 1e-13}, "test").converged);
    CHECK(a.residual() < 1e-12);
    CHECK((a.multipliers - b.multipliers).norm() < 1e-9 * b.multipliers.norm());
    CHECK(a.violation()[7] == Approx(0.1));
    CHECK(a.multipliers.segment(4, 2).isZero());
  }
}

TEST_CASE("a problem without a solution is said so, and equalities that repeat") {
  const Eigen::MatrixXd M{{1, -1}, {-1, 1}};
  ConstraintProblem p = unilateral(M, Eigen::Vector2d(-1, -1));
  p.multipliers.setOnes();
  const SweepResult result = LinearComplementarity().solve(p, "test");
  CHECK_FALSE(result.converged);
  CHECK(result.error == Approx(1));
  CHECK(p.multipliers.isZero());

  p.blocks = {ConstraintBlock::equality(0, 1), ConstraintBlock::equality(1, 1)};
  CHECK_THAT(error_of([&] { LinearComplementarity().solve(p, "root"); }),
             Catch::Contains("1 of the 2 equalities"));
  ConstraintProblem rubbing = box_stack(1, 1).problem();
  CHECK_THAT(error_of([&] { LinearComplementarity().solve(rubbing, "root"); }),
             Catch::Contains("row 0") && Catch::Contains("without friction"));
}

TEST_CASE("contacts with friction as SOFA iterates them: a hand-made sweep, its error and its limit") {
  ConstraintProblem p = box_stack(2, 7).problem();
  const ConstraintProblem first = p;
  const SweepResult result = ComplementaritySweeps().solve(p, {.maxIterations = 1, .tolerance = 0}, "test");
  CHECK(result.iterations == 1);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(p.rows());
  double error = 0;
  for (int c = 0; c < p.rows(); c += 3) {
    const Eigen::Vector3d d = first.freeViolation.segment<3>(c) + first.compliance.middleRows<3>(c) * f;
    const Eigen::Matrix3d W = first.compliance.block<3, 3>(c, c);
    if (d[0] < 0) {
      Eigen::Vector3d s(-d[0] / W(0, 0), 0, 0);
      const double mean = (W(1, 1) + W(2, 2)) / 2, mu = p.blocks[std::size_t(c / 3)].friction;
      s.tail<2>() = -(d.tail<2>() + W.col(0).tail<2>() * s[0]) / mean;
      if (s.tail<2>().norm() > mu * s[0]) s.tail<2>() *= mu * s[0] / s.tail<2>().norm();
      f.segment<3>(c) = s;
      error += (W * s).norm();
    }
  }
  CHECK((p.multipliers - f).norm() < 1e-14);
  CHECK(result.error == Approx(error));

  // the limit is one for each of the eight contacts, and one more
  ConstraintProblem q = first;
  CHECK(ComplementaritySweeps().solve(q, {.maxIterations = 1, .tolerance = error / 8.99}, "test").converged);
  q = first;
  CHECK_FALSE(
      ComplementaritySweeps().solve(q, {.maxIterations = 1, .tolerance = error / 9.01}, "test").converged);
  // without friction it is not scaled
  q = first;
  for (ConstraintBlock& b : q.blocks) b.friction = 0;
  const SweepResult smooth = ComplementaritySweeps().solve(q, {.maxIterations = 1, .tolerance = 0}, "test");
  q.multipliers.setZero();
  CHECK_FALSE(ComplementaritySweeps()
                  .solve(q, {.maxIterations = 1, .tolerance = smooth.error * 0.99}, "test")
                  .converged);
}

TEST_CASE("a first guess is taken, or not") {
  const ConstraintProblem p = soft_grid(3, 4).problem();
  ConstraintProblem solved = p;
  ComplementaritySweeps sweeps;
  REQUIRE(sweeps.solve(solved, {.maxIterations = 100000, .tolerance = 1e-10}, "test").iterations > 5);
  ConstraintProblem again = solved;
  CHECK(sweeps.solve(again, {.tolerance = 1e-8}, "test").iterations == 1);
  again = solved;
  CHECK(sweeps.solve(again, {.tolerance = 1e-8, .initialGuess = false}, "test").iterations > 2);
}

TEST_CASE("minW leaves out what can hardly move, maxF what would need too large a force") {
  // three masses on the ground, 1 kg, 2 kg and fixed
  ConstraintProblem p{
      Eigen::Matrix3d(Eigen::Vector3d(1, 0.5, 0).asDiagonal()),
      Eigen::Vector3d(-1, -1, -1),
      Eigen::VectorXd::Zero(3),
      {ConstraintBlock::unilateral(0), ConstraintBlock::unilateral(1), ConstraintBlock::unilateral(2)}};
  ConstraintProblem q = p;
  CHECK_THAT(error_of([&] { ComplementaritySweeps().solve(q, {}, "root"); }),
             Catch::Contains("constraint 2") && Catch::Contains("fixed points"));
  REQUIRE(ComplementaritySweeps().solve(q, {.minW = 1e-9}, "test").converged);
  CHECK((q.multipliers - Eigen::Vector3d(1, 2, 0)).norm() < 1e-15);
  q = p;
  REQUIRE(ComplementaritySweeps().solve(q, {.minW = 1e-9, .maxF = 1.5}, "test").converged);
  CHECK((q.multipliers - Eigen::Vector3d(1, 0, 0)).norm() < 1e-15);
  // with friction only where the iterations have converged, as in SOFA
  ConstraintProblem rubbing = box_stack(3, 2).problem();
  ConstraintProblem unfinished = rubbing;
  ComplementaritySweeps().solve(rubbing, {.maxIterations = 100000, .tolerance = 1e-9, .maxF = 1e-9}, "test");
  CHECK(rubbing.multipliers.isZero());
  ComplementaritySweeps().solve(unfinished, {.maxIterations = 2, .tolerance = 0, .maxF = 1e-9}, "test");
  CHECK(unfinished.multipliers.norm() > 1e-3);
  // equalities hold, whatever minW and maxF are
  q = p;
  q.blocks[0] = ConstraintBlock::equality(0, 1);
  REQUIRE(ComplementaritySweeps().solve(q, {.minW = 0.6, .maxF = 0.5}, "test").converged);
  CHECK(q.multipliers[0] == Approx(1));
  CHECK(q.multipliers[1] == 0);
}

TEST_CASE("equalities among contacts are solved by SOFA's iteration as by Gauss-Seidel") {
  ConstraintProblem p = soft_grid(3, 2).problem();
  p.blocks[2] = ConstraintBlock::equality(6, 3);
  ConstraintProblem a = p, b = p;
  REQUIRE(ComplementaritySweeps().solve(a, exact, "test").converged);
  REQUIRE(ConstraintSweeps()
              .gaussSeidel(b, {.maxIterations = 100000, .tolerance = 1e-12, .scaleTolerance = false}, "test")
              .converged);
  CHECK(a.residual() < 1e-11);
  CHECK((a.multipliers - b.multipliers).norm() < 1e-8 * b.multipliers.norm());
  CHECK(a.violation().segment(6, 3).norm() < 1e-11);
}

}  // namespace test_linear_complementarity
