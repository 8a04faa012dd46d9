// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/nncg_constraint_solver.hpp>

namespace test_nncg_constraint_solver {

using namespace sinew;
using namespace friction_problems;

TEST_CASE(
    "NNCGConstraintSolver: forces of soft contacts fulfil their conditions, and those are the same from any "
    "guess") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    ConstraintProblem p = soft_grid(4, seed, 0.1, 0.5).problem(), q = p;
    NNCGConstraintSolver solver{.maxIterations = 100000, .tolerance = 1e-12, .stopsUnsolved = true};
    solver.solve(p, "test");
    CHECK(p.residual() < 1e-9 * p.freeViolation.norm());
    CHECK(p.multipliers.norm() > 1e-3);
    q.multipliers.setConstant(0.1);
    solver.solve(q, "test");
    CHECK((q.multipliers - p.multipliers).norm() < 1e-8 * p.multipliers.norm());
    const int again = [&] {
      solver.tolerance = 1e-9;
      solver.solve(q, "test");
      return solver.result.iterations;
    }();
    CHECK(again <= 2);
  }
}

TEST_CASE("NNCGConstraintSolver: its fields are those of the iteration") {
  // two equalities on one body, that do not agree: with a compliance they share what is between
  ConstraintProblem p{ConstraintProblem::Matrix::Ones(2, 2),
                      Eigen::Vector2d(1, -1),
                      Eigen::VectorXd::Zero(2),
                      {ConstraintBlock::equality(0, 1), ConstraintBlock::equality(1, 1)}};
  ConstraintProblem q = p;
  NNCGConstraintSolver solver{.maxIterations = 50, .tolerance = 1e-9};
  solver.solve(p, "root");
  CHECK_FALSE(solver.result.converged);
  CHECK(solver.result.iterations == 50);
  CHECK(solver.result.error > 0.5);
  CHECK(p.multipliers.allFinite());
  solver.stopsUnsolved = true;
  CHECK_THAT(
      error_of([&] { solver.solve(p, "root"); }),
      Catch::Contains("root") && Catch::Contains("NNCGConstraintSolver") && Catch::Contains("50 iterations"));
  solver.regularizationTerm = 0.5;
  solver.maxIterations = 1000;
  solver.solve(q, "root");
  CHECK(q.multipliers[0] == Approx(-2));  // f0 + f1 = 0, 0.5 f0 = -1
  CHECK(q.multipliers[1] == Approx(2));

  // the tolerance is one for each of the rows, or for each row
  ConstraintProblem scaled = soft_grid(3, 1).problem(), each = scaled, sum = scaled;
  solver = {.maxIterations = 10000, .tolerance = 1e-6};
  solver.solve(scaled, "test");
  CHECK(solver.result.error <= 1e-6 * scaled.rows());
  const int ofScaled = solver.result.iterations;
  solver.scaleTolerance = false;
  solver.solve(sum, "test");
  CHECK(solver.result.error <= 1e-6);
  CHECK(solver.result.iterations > ofScaled);
  solver.allVerified = true;
  solver.solve(each, "test");
  CHECK(solver.result.error <= 1e-6);
}

}  // namespace test_nncg_constraint_solver
