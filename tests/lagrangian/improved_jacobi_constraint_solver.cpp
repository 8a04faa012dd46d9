// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/improved_jacobi_constraint_solver.hpp>

namespace test_improved_jacobi_constraint_solver {

using namespace sinew;
using namespace friction_problems;

// equalities on one body: eigenvalues of W are 0.1 and n + 0.1
ConstraintProblem on_one_body(int n) {
  ConstraintProblem p{ConstraintProblem::Matrix::Ones(n, n),
                      Eigen::VectorXd::LinSpaced(n, 1, 2),
                      Eigen::VectorXd::Zero(n),
                      {}};
  p.compliance.diagonal().array() += 0.1;
  for (int i = 0; i < n; ++i) p.blocks.push_back(ConstraintBlock::equality(i, 1));
  return p;
}

TEST_CASE("many constraints on one body diverge without a weight, and are solved with that of the spectrum") {
  for (const int n : {3, 30}) {
    ConstraintProblem p = on_one_body(n), q = p;
    ImprovedJacobiConstraintSolver plain{.maxIterations = 20000, .tolerance = 1e-12};
    plain.solve(p, "test");
    CHECK_FALSE(plain.result.converged);
    CHECK(p.multipliers.isZero());  // and no NaN
    ImprovedJacobiConstraintSolver weighed{
        .maxIterations = 20000, .tolerance = 1e-13, .stopsUnsolved = true, .useSpectralCorrection = true};
    weighed.solve(q, "test");
    // (1 1' + 0.1)^-1 d, by Sherman and Morrison
    const Eigen::VectorXd d = q.freeViolation;
    const Eigen::VectorXd f = -(d.array() - d.sum() / (0.1 + n)) / 0.1;
    CHECK((q.multipliers - f).norm() < 1e-9 * f.norm());
  }
}

// The weight is that of W in SOFA's unit, so that a body that is 100 times as heavy, in a step of a
// hundredth, has the same iterates.
TEST_CASE("the weight is SOFA's whatever the length of the step") {
  ConstraintProblem a = on_one_body(8), b = a;
  b.compliance /= 100;
  b.timeStep = a.timeStep / 100;
  ImprovedJacobiConstraintSolver solver{.maxIterations = 7, .tolerance = 0, .useSpectralCorrection = true};
  solver.solve(a, "test");
  solver.solve(b, "test");
  CHECK((100 * a.multipliers - b.multipliers).norm() < 1e-12 * b.multipliers.norm());
  // a factor of it goes the first step that much less far
  ConstraintProblem one = on_one_body(8), half = one;
  solver.maxIterations = 1;
  solver.solve(one, "test");
  solver.spectralCorrectionFactor = 0.5;
  solver.solve(half, "test");
  CHECK((one.multipliers - 2 * half.multipliers).norm() < 1e-14);
  CHECK(one.multipliers.norm() > 0.1);
}

TEST_CASE("momentum: the last change counts the more the later, and the solution is the same") {
  const ConstraintProblem p = soft_grid(4, 2).problem();
  ConstraintProblem a = p, b = p, reference = p;
  ImprovedJacobiConstraintSolver without{
      .maxIterations = 5000, .tolerance = 1e-7, .stopsUnsolved = true, .useSpectralCorrection = true};
  ImprovedJacobiConstraintSolver with = without;
  with.useConjugateResidue = true;
  with.conjugateResidueSpeedFactor = 0.1;
  without.solve(a, "test");
  with.solve(b, "test");
  CHECK(with.result.iterations < without.result.iterations);
  REQUIRE(ConstraintSweeps()
              .gaussSeidel(reference, {.maxIterations = 100000, .tolerance = 1e-10}, "test")
              .converged);
  // the last change is smaller than the error by the rate of convergence
  for (ConstraintProblem const* each : {&a, &b})
    CHECK((p.compliance * (each->multipliers - reference.multipliers)).norm() <
          1e-3 * p.freeViolation.norm());
}

TEST_CASE("the order of the contacts does not matter") {
  const ConstraintProblem p = soft_grid(3, 6).problem();
  const int n = p.rows();
  ConstraintProblem turned = p;
  std::reverse(turned.blocks.begin(), turned.blocks.end());
  for (int i = 0; i < n; i += 3) {
    turned.blocks[std::size_t(i / 3)].first = i;
    turned.freeViolation.segment<3>(i) = p.freeViolation.segment<3>(n - 3 - i);
    for (int j = 0; j < n; j += 3)
      turned.compliance.block<3, 3>(i, j) = p.compliance.block<3, 3>(n - 3 - i, n - 3 - j);
  }
  ConstraintProblem a = p;
  ImprovedJacobiConstraintSolver solver{.maxIterations = 5, .tolerance = 0};
  solver.solve(a, "test");
  solver.solve(turned, "test");
  REQUIRE(a.multipliers.norm() > 1e-3);
  for (int i = 0; i < n; i += 3)
    CHECK((turned.multipliers.segment<3>(i) - a.multipliers.segment<3>(n - 3 - i)).norm() <
          1e-12 * a.multipliers.norm());
}

TEST_CASE("what is not solved stops where that is wanted, and bad numbers are refused") {
  ConstraintProblem p = on_one_body(30);
  ImprovedJacobiConstraintSolver solver{.tolerance = 1e-9, .stopsUnsolved = true};
  CHECK_THAT(error_of([&] { solver.solve(p, "root"); }),
             Catch::Contains("root") && Catch::Contains("ImprovedJacobiConstraintSolver") &&
                 Catch::Contains("not solved"));
  p.compliance(0, 0) = std::nan("");
  solver.useSpectralCorrection = true;
  CHECK_THAT(error_of([&] { solver.solve(p, "root"); }), Catch::Contains("not a finite number"));
}

}  // namespace test_improved_jacobi_constraint_solver
