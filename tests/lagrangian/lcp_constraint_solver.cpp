// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/lcp_constraint_solver.hpp>

namespace test_lcp_constraint_solver {

using namespace sinew;
using namespace friction_problems;

// 2 kg on a slope after a step of free fall: velocities [m/s], multipliers [N s]
ConstraintProblem slope(double angle, double ofContact) {
  return {ConstraintProblem::Matrix::Identity(3, 3) / 2,
          0.0981 * Eigen::Vector3d(-std::cos(angle), std::sin(angle), 0),
          Eigen::VectorXd::Zero(3),
          {ConstraintBlock::contact(0, ofContact)}};
}

TEST_CASE("the friction of the solver is that of all contacts, whatever they have") {
  for (const double mu : {0., 0.3, 0.6, 1e9})
    for (const double ofContact : {0., 0.45, 10.}) {
      const double angle = 0.4;
      ConstraintProblem p = slope(angle, ofContact);
      LCPConstraintSolver solver{.tolerance = 1e-14, .mu = mu, .stopsUnsolved = true};
      solver.solve(p, "test");
      const double down = std::max(0., std::sin(angle) - mu * std::cos(angle));
      CHECK(std::abs(p.violation()[0]) < 1e-15);
      CHECK(p.violation()[1] == Approx(0.0981 * down).margin(1e-14));
      CHECK(p.multipliers[0] == Approx(2 * 0.0981 * std::cos(angle)));
      CHECK(solver.result.iterations <= 2);
    }
}

TEST_CASE("without friction Lemke's method and the iteration carry a stack, whose contacts share the load") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const ConstraintProblem p =
        box_stack(4, seed).problem();  // four contacts a face, of which three would do
    ConstraintProblem a = p, b = p;
    LCPConstraintSolver iteration{.maxIterations = 200000, .tolerance = 1e-10, .mu = 0},
        pivots{.mu = 0, .lemke = true, .stopsUnsolved = true};
    iteration.solve(a, "test");
    pivots.solve(b, "test");
    REQUIRE(iteration.result.converged);
    CHECK(pivots.result.error < 1e-12);
    CHECK(pivots.result.iterations < 4 * p.rows() / 3);
    // the motion is one only, J A^-1 J' f, since W is semidefinite
    CHECK((p.compliance * (a.multipliers - b.multipliers)).norm() < 1e-6 * p.freeViolation.norm());
  }
}

TEST_CASE("with friction the velocities are those of block Gauss-Seidel, equalities among contacts hold") {
  ConstraintProblem p = soft_grid(4, 3, 0.4, 0.4).problem();
  p.blocks[5] = ConstraintBlock::equality(15, 3);
  ConstraintProblem a = p, b = p;
  LCPConstraintSolver solver{.maxIterations = 100000, .tolerance = 1e-12, .mu = 0.4, .stopsUnsolved = true};
  solver.solve(a, "test");
  REQUIRE(ConstraintSweeps()
              .gaussSeidel(b, {.maxIterations = 100000, .tolerance = 1e-13, .scaleTolerance = false}, "test")
              .converged);
  CHECK((a.multipliers - b.multipliers).norm() < 1e-8 * b.multipliers.norm());
  CHECK(a.violation().segment(15, 3).norm() < 1e-10);
}

TEST_CASE("the first guess is that of the last step, or zero") {
  const ConstraintProblem p = soft_grid(3, 4, 0.3, 0.3).problem();
  LCPConstraintSolver solver{.maxIterations = 100000, .tolerance = 1e-10, .mu = 0.3};
  ConstraintProblem solved = p;
  solver.solve(solved, "test");
  REQUIRE(solver.result.iterations > 5);
  solver.tolerance = 1e-8;
  ConstraintProblem again = solved;
  solver.solve(again, "test");
  CHECK(solver.result.iterations == 1);
  again = solved;
  solver.initial_guess = false;
  solver.solve(again, "test");
  CHECK(solver.result.iterations > 2);
}

TEST_CASE("a regularization is added to the compliance: what sinks in is force times that") {
  ConstraintProblem p{ConstraintProblem::Matrix{{0.5}},
                      Eigen::VectorXd::Constant(1, -1),
                      Eigen::VectorXd::Zero(1),
                      {ConstraintBlock::unilateral(0)}};
  for (const bool lemke : {false, true}) {
    ConstraintProblem q = p;
    LCPConstraintSolver{.tolerance = 1e-14, .mu = 0, .regularizationTerm = 0.5, .lemke = lemke}.solve(q,
                                                                                                      "test");
    CHECK(q.multipliers[0] == Approx(1));
  }
}

TEST_CASE("what is not solved says by how much, and stops where that is wanted") {
  ConstraintProblem p = box_stack(5, 1).problem();
  LCPConstraintSolver solver{.maxIterations = 2, .tolerance = 1e-9, .mu = 0.5};
  solver.solve(p, "root");
  CHECK_FALSE(solver.result.converged);
  CHECK(solver.result.error > 1e-9);
  CHECK(p.multipliers.allFinite());
  solver.stopsUnsolved = true;
  CHECK_THAT(error_of([&] { solver.solve(p, "root"); }),
             Catch::Contains("root") && Catch::Contains("LCPConstraintSolver") &&
                 Catch::Contains("2 iterations") && Catch::Contains("maxIt"));

  // two contacts against each other, that both are to open
  ConstraintProblem q{ConstraintProblem::Matrix{{1, -1}, {-1, 1}},
                      Eigen::Vector2d(-1, -1),
                      Eigen::VectorXd::Zero(2),
                      {ConstraintBlock::unilateral(0), ConstraintBlock::unilateral(1)}};
  LCPConstraintSolver pivots{.mu = 0, .lemke = true};
  pivots.solve(q, "root");
  CHECK_FALSE(pivots.result.converged);
  CHECK(pivots.result.error == Approx(1));
  CHECK(q.multipliers.isZero());
  pivots.stopsUnsolved = true;
  CHECK_THAT(error_of([&] { pivots.solve(q, "root"); }),
             Catch::Contains("broken by 1 m") && Catch::Contains("contradict"));
  pivots.mu = 0.5;
  CHECK_THAT(error_of([&] { pivots.solve(q, "root"); }),
             Catch::Contains("mu is 0.5") && Catch::Contains("lemke to false"));
  q.freeViolation[0] = std::nan("");
  CHECK_THAT(error_of([&] { solver.solve(q, "root"); }), Catch::Contains("not a finite number"));
}

}  // namespace test_lcp_constraint_solver
