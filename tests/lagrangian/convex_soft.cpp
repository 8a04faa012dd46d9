// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "lagrangian/soft_block.hpp"

#include <sinew/lagrangian/constrained_block_jacobi.hpp>
#include <sinew/lagrangian/constraint_sweeps.hpp>
#include <sinew/lagrangian/convex_step.hpp>

namespace test_convex_soft {

using namespace sinew;

struct Solution {
  Eigen::VectorXd velocity, multipliers;
  ConvexStepResult result;
};
Solution solve(soft_block::Problem const& p, ConvexStepSettings const& settings) {
  ConstrainedBlockJacobi<3> preconditioner;
  preconditioner.system = p.diagonal;
  ConvexStep step;
  Solution s{p.free, Eigen::VectorXd::Zero(p.start.size()), {}};
  s.result = step.solve([&](Eigen::VectorXd const& x, Eigen::VectorXd& y) { y.noalias() = p.A * x; },
                        preconditioner,
                        p.A * p.free,
                        p.rows,
                        p.blocks,
                        p.start,
                        s.velocity,
                        s.multipliers,
                        settings,
                        "test");
  return s;
}

TEST_CASE("soft blocks on a plane and on each other move as Gauss-Seidel on W has it, stiff or not") {
  for (const int count : {1, 2})
    for (const double stiffness : {1., 100.})
      for (const double mu : {0., 0.3, 0.7}) {
        const soft_block::Problem p = soft_block::make(
            {.nx = 4, .ny = 4, .nz = 2, .count = count, .young = 1e4 * stiffness, .mu = mu, .gap = 1e-4});
        const Solution s = solve(p, {.tolerance = 1e-8, .momentumTolerance = 1e-9, .maxUpdates = 100});
        CAPTURE(count, stiffness, mu, s.result.residual, s.result.momentum, s.result.updates);
        REQUIRE(s.result.converged);

        const Eigen::SparseMatrix<double> J = soft_block::jacobian(p);
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(Eigen::SparseMatrix<double>(p.A));
        const Eigen::MatrixXd Y = factor.solve(Eigen::MatrixXd(J.transpose()));
        const Eigen::MatrixXd W = J * Y;
        ConstraintProblem q{
            (W + W.transpose()) / 2, J * p.free + p.start, Eigen::VectorXd::Zero(p.start.size()), p.blocks};
        ConstraintProblem mine = q;
        mine.multipliers = s.multipliers;
        // The solver knows W by the diagonal blocks of A alone; an error of the multipliers counts for less
        // by the ratio of both. That of the momentum counts for more by the square root of the condition of
        // A, some 100.
        Eigen::MatrixXd D = Eigen::MatrixXd::Zero(p.A.rows(), p.A.cols());
        for (int i = 0; i < p.points; ++i) D.block<3, 3>(3 * i, 3 * i) = p.diagonal[std::size_t(i)].inverse();
        const Eigen::MatrixXd estimate = J * D * J.transpose();
        const double ratio = (W.diagonal().array() / estimate.diagonal().array()).maxCoeff();
        const double error = 1e-8 * ratio + 1e-9 * 100;
        CAPTURE(ratio);
        CHECK(mine.residual() < error);
        ConstraintSweeps sweeps;
        for (int i = 0; i < 100 && q.residual() > 1e-9; ++i)
          sweeps.gaussSeidel(q, {.maxIterations = 200, .tolerance = 0}, "test");
        REQUIRE(q.residual() < 1e-9);
        const Eigen::VectorXd velocity = p.free + Y * q.multipliers;
        CHECK((s.velocity - velocity).lpNorm<Eigen::Infinity>() < 4 * error);
        CHECK((s.multipliers - q.multipliers).norm() < 1e-4 * q.multipliers.norm());
      }
}

TEST_CASE("forces of contact balance the change of momentum, and energy does not grow") {
  const soft_block::Problem p = soft_block::make({.nx = 5, .ny = 5, .nz = 2, .young = 1e6});
  const Solution s = solve(p, {.tolerance = 1e-7, .momentumTolerance = 1e-9});
  REQUIRE(s.result.converged);
  // of the body as a whole: internal forces have no sum, and A 1 = M 1
  Eigen::Vector3d change(0, 0, 0), force(0, 0, 0);
  const Eigen::VectorXd momentum = p.A * (s.velocity - p.free);
  for (int i = 0; i < p.points; ++i) change += momentum.segment<3>(3 * i);
  for (int c = 0; c < p.rows.rows(); c += 3)  // rows are z, x, y
    force += Eigen::Vector3d(s.multipliers[c + 1], s.multipliers[c + 2], s.multipliers[c]);
  CHECK((change - force).norm() < 1e-6 * force.norm());
  // an implicit step to v from v* takes 1/2 |v - v*|^2 and what friction does
  const double before = p.free.dot(p.A * p.free), after = s.velocity.dot(p.A * s.velocity);
  CHECK(after < before);
}

TEST_CASE("each outer update takes most of the gap that the regularisation leaves") {
  const soft_block::Problem p = soft_block::make({.nx = 5, .ny = 5, .nz = 2, .young = 1e5, .mu = 0});
  double last = 0;
  for (int updates = 0; updates < 4; ++updates) {
    // all updates with one regularisation, each problem solved to the end
    const Solution s = solve(p,
                             {.tolerance = 0,
                              .momentumTolerance = 1e-12,
                              .firstRegularisation = 0.1,
                              .reduction = 1e-9,
                              .maxUpdates = updates});
    // r = 0.1 W_bb; W has eigenvalues from 0.3 W_bb
    if (updates > 0) CHECK(s.result.residual < 0.4 * last);
    last = s.result.residual;
  }
}

}  // namespace test_convex_soft
