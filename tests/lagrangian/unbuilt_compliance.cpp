// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/block_gauss_seidel_constraint_solver.hpp>
#include <sinew/lagrangian/unbuilt_gauss_seidel_constraint_solver.hpp>

namespace test_unbuilt_compliance {

using namespace sinew;
using namespace friction_problems;

namespace {

// the same problem by its factors
ConstraintProblem unbuilt(Contacts const& contacts, ConstraintProblem const& built) {
  ConstraintProblem p = built;
  p.built = false;
  p.compliance.resize(0, 0);
  const Eigen::MatrixXd U = contacts.inverseMass * contacts.J.transpose();
  for (Eigen::Index i = 0; i < contacts.J.rows(); ++i) {
    for (Eigen::Index k = 0; k < contacts.J.cols(); ++k) {
      if (contacts.J(i, k) != 0) p.unbuilt.jacobian.add(int(k), contacts.J(i, k));
      if (U(k, i) != 0) p.unbuilt.answers.add(int(k), U(k, i));
    }
    p.unbuilt.jacobian.endRow();
    p.unbuilt.answers.endRow();
  }
  p.unbuilt.begin(p.blocks, int(contacts.J.cols()));
  return p;
}
// contacts, of which some are equalities and some intervals, each row for itself
ConstraintProblem mixed(Contacts const& contacts) {
  ConstraintProblem p = contacts.problem();
  p.blocks.clear();
  for (int first = 0; first < p.rows(); first += 3) switch (first / 3 % 3) {
      case 0:
        p.blocks.push_back(ConstraintBlock::contact(first, 0.4));
        break;
      case 1:
        p.blocks.push_back(ConstraintBlock::equality(first, 3));
        break;
      default:
        for (int i = 0; i < 3; ++i) p.blocks.push_back(ConstraintBlock::interval(first + i, -0.01, 0.02));
    }
  return p;
}

}  // namespace

TEST_CASE("an unbuilt compliance is the product of its factors, with what is added to its blocks") {
  const Contacts contacts = soft_grid(4, 3, 0.1, 0.5);
  ConstraintProblem p = mixed(contacts);
  const double size = p.compliance.norm();
  for (ConstraintBlock const& b : p.blocks)
    for (int i = b.first; i < b.first + b.rows; ++i) p.add(i, i, 1e-3 * size * (1 + i % 2));
  ConstraintProblem q = unbuilt(contacts, p);
  for (ConstraintBlock const& b : q.blocks)
    for (int i = b.first; i < b.first + b.rows; ++i) q.add(i, i, 1e-3 * size * (1 + i % 2));
  auto same = [&] {
    CHECK((q.products(q.rows()) - p.compliance).norm() < 1e-14 * size);
    for (ConstraintBlock const& b : p.blocks) CHECK((q.own(b) - p.own(b)).norm() < 1e-14 * size);
    p.multipliers.setLinSpaced(p.rows(), -1, 2);
    q.multipliers = p.multipliers;
    q.multipliersSet();
    CHECK((q.violation() - p.violation()).norm() < 1e-13 * p.violation().norm());
    for (ConstraintBlock const& b : p.blocks)
      CHECK((q.violation(b) - p.violation(b)).norm() < 1e-13 * p.violation().norm());
    CHECK(q.residual() == Approx(p.residual()).epsilon(1e-12));
  };
  same();
  const ConstraintBlock left = p.blocks[0];
  p.leaveOut(left, left.first + 1, 0.7 * size);
  q.leaveOut(left, left.first + 1, 0.7 * size);
  same();
  // a step of one block is told, and all others have it
  const ConstraintBlock b = p.blocks[1];
  const BlockVector step = BlockVector::LinSpaced(b.rows, 0.5, 2);
  for (ConstraintProblem* one : {&p, &q}) {
    one->multipliers.segment(b.first, b.rows) += step;
    one->moved(b, step);
  }
  for (ConstraintBlock const& other : p.blocks)
    CHECK((q.violation(other) - p.violation(other)).norm() < 1e-13 * p.violation().norm());
}

TEST_CASE("UnbuiltGaussSeidelConstraintSolver: the iterates of Gauss-Seidel over W, of all kinds of blocks") {
  int converged = 0;
  for (const double sor : {1., 0.8})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const Contacts contacts = soft_grid(4, seed, 0.1, 0.5);
      ConstraintProblem p = mixed(contacts), q = unbuilt(contacts, p);
      p.multipliers.setConstant(0.1);
      q.multipliers.setConstant(0.1);
      for (const int iterations : {1, 7, 500}) {
        BlockGaussSeidelConstraintSolver built{.maxIterations = iterations, .tolerance = 1e-9, .sor = sor};
        UnbuiltGaussSeidelConstraintSolver solver{.maxIterations = iterations, .tolerance = 1e-9, .sor = sor};
        built.solve(p, "test");
        solver.solve(q, "test");
        CHECK(solver.result.iterations == built.result.iterations);
        CHECK(solver.result.error == Approx(built.result.error).epsilon(1e-6));
        CHECK((q.multipliers - p.multipliers).norm() < 1e-10 * p.multipliers.norm());
        CHECK(solver.result.converged == built.result.converged);
        converged += built.result.converged;
      }
      CHECK(p.multipliers.norm() > 1e-3);
    }
  CHECK(converged > 2);
}

TEST_CASE("UnbuiltGaussSeidelConstraintSolver: equalities on one body share by regularizationTerm") {
  const Contacts one{Eigen::MatrixXd::Ones(2, 1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Zero(1), {}};
  ConstraintProblem p{ConstraintProblem::Matrix::Ones(2, 2),
                      Eigen::Vector2d(1, -1),
                      Eigen::VectorXd::Zero(2),
                      {ConstraintBlock::equality(0, 1), ConstraintBlock::equality(1, 1)}};
  ConstraintProblem q = unbuilt(one, p), broken = q;
  UnbuiltGaussSeidelConstraintSolver solver{.tolerance = 1e-9, .regularizationTerm = 0.5};
  solver.solve(q, "root");
  CHECK(solver.result.converged);
  CHECK(q.multipliers[0] == Approx(-2));  // f0 + f1 = 0, 0.5 f0 = -1
  CHECK(q.multipliers[1] == Approx(2));
  solver = {.maxIterations = 50, .stopsUnsolved = true};
  CHECK_THAT(error_of([&] { solver.solve(broken, "root"); }),
             Catch::Contains("UnbuiltGaussSeidelConstraintSolver") && Catch::Contains("50 iterations"));
  // numbers that are none
  broken.unbuilt.jacobian.values[0] = std::numeric_limits<double>::quiet_NaN();
  broken.unbuilt.begin(broken.blocks, 1);
  CHECK_THAT(error_of([&] { solver.solve(broken, "root"); }), Catch::Contains("not a finite number"));
}

}  // namespace test_unbuilt_compliance
