// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "lagrangian/contact_scenes.hpp"
#include "registry_scene.hpp"

#include <Eigen/Cholesky>

#include <random>

namespace test_preconditioned_conjugate_residual {

using namespace sinew;
using Solver = PreconditionedConjugateResidual;

namespace {

// equalities in blocks of 1, 2 and 3 rows, whose W has a diagonal from 1e-6 to 1
ConstraintProblem equalities(int n, unsigned seed, int rank) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(n, rank, [&] { return number(random); });
  for (int i = 0; i < n; ++i) J.row(i) *= std::pow(10., -3. * i / n);
  ConstraintProblem p;
  p.compliance = J * J.transpose();
  // what forces can do
  p.freeViolation = J * Eigen::VectorXd::NullaryExpr(rank, [&] { return number(random); });
  p.multipliers = Eigen::VectorXd::Ones(n);
  for (int row = 0, size = 1; row < n; row += size, size = size % 3 + 1) {
    size = std::min(size, n - row);
    p.blocks.push_back(ConstraintBlock::equality(row, size));
  }
  return p;
}

}  // namespace

TEST_CASE("conjugate residuals fulfil n equalities in n iterations, whatever the scale of their rows") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    ConstraintProblem p = equalities(12, seed, 40);
    Solver solver{.tolerance = 1e-10, .scaleTolerance = false};
    solver.solve(p, "test");
    CHECK(solver.result.converged);
    CHECK(solver.result.iterations <= 12);
    CHECK(solver.result.error <= 1e-10);
    CHECK(p.violation().norm() < 1e-10);
    const Eigen::VectorXd f = Eigen::MatrixXd(p.compliance).ldlt().solve(-p.freeViolation);
    CHECK((p.multipliers - f).norm() < 1e-6 * f.norm());
  }
}

TEST_CASE(
    "conjugate residuals: rows that depend on each other are fulfilled, those that contradict each other "
    "stay") {
  ConstraintProblem p = equalities(12, 3, 7);
  Solver solver{.tolerance = 1e-9, .scaleTolerance = false};
  solver.solve(p, "test");
  CHECK(solver.result.converged);
  CHECK(solver.result.iterations <= 8);
  CHECK(p.violation().norm() < 1e-9);

  ConstraintProblem q{ConstraintProblem::Matrix::Ones(2, 2),
                      Eigen::Vector2d(1, -1),
                      Eigen::VectorXd::Zero(2),
                      {ConstraintBlock::equality(0, 1), ConstraintBlock::equality(1, 1)}};
  solver.solve(q, "test");
  CHECK_FALSE(solver.result.converged);
  CHECK(solver.result.error == Approx(2));
  CHECK(q.multipliers.norm() < 1e-12);
  solver.stopsUnsolved = true;
  CHECK_THAT(
      error_of([&] { solver.solve(q, "/root"); }),
      Catch::StartsWith("/root: PreconditionedConjugateResidual: the constraints are not solved after"));
}

TEST_CASE(
    "conjugate residuals: the tolerance is of the sum over blocks, of each row of it, or of the largest") {
  const ConstraintProblem start = equalities(24, 7, 60);
  auto solved = [&](Solver solver) {
    ConstraintProblem p = start;
    solver.solve(p, "test");
    REQUIRE(solver.result.converged);
    double sum = 0, largest = 0;
    const Eigen::VectorXd d = p.violation();
    for (auto const& b : p.blocks) {
      sum += d.segment(b.first, b.rows).norm();
      largest = std::max(largest, d.segment(b.first, b.rows).norm());
    }
    return std::pair{sum, largest};
  };
  const auto scaled = solved({.tolerance = 1e-3}), sum = solved({.tolerance = 1e-3, .scaleTolerance = false}),
             each = solved({.tolerance = 1e-3, .allVerified = true});
  CHECK(scaled.first <= 24e-3);
  CHECK(sum.first <= 1e-3);
  CHECK(each.second <= 1e-3);
  CHECK(scaled.first > 1e-3);
  // fewer iterations than equations do not do
  Solver few{.maxIterations = 3, .tolerance = 1e-9};
  ConstraintProblem p = start;
  few.solve(p, "test");
  CHECK(few.result.iterations == 3);
  CHECK_FALSE(few.result.converged);
}

TEST_CASE("conjugate residuals: a chain of points hangs as by sweeps, and a contact is refused by its name") {
  auto chain = [](auto solver, bool stops) {
    // six points that keep their distances along a line, the first of them held
    BilateralLagrangianConstraint<Vec3d> joints{.first_point = {0, 1, 2, 3, 4},
                                                .second_point = {1, 2, 3, 4, 5}};
    Vec3d::VecCoord x;
    for (int i = 0; i < 6; ++i) x.push_back({0.1 * i, 0, 0});
    UnilateralLagrangianConstraint<Vec3d> stop{
        .first_point = {0}, .second_point = {5}, .normal = {{0, 0, 1}}};
    if (!stops) stop.first_point.clear(), stop.second_point.clear(), stop.normal.clear();
    auto sim = RegistryScene{node<"root">(Gravity{{0, 0, -10}},
                                          FreeMotionAnimationLoop{},
                                          solver,
                                          node<"chain">(EulerExplicitSolver{},
                                                        MechanicalObject<Vec3d>{.position = x},
                                                        UniformMass<Vec3d>{.vertexMass = 0.5},
                                                        FixedLagrangianConstraint<Vec3d>{.indices = {0}},
                                                        joints,
                                                        stop))};
    sim.init();
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    return sim;
  };
  auto by = chain(Solver{.tolerance = 1e-13}, false);
  auto other = chain(BlockGaussSeidelConstraintSolver{.maxIterations = 100000, .tolerance = 1e-14}, false);
  auto const &x = by.at<"chain">().state().position, &y = other.at<"chain">().state().position;
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - y[i]).norm() < 1e-10);
  auto const& f = by.at<"chain">().get<FixedLagrangianConstraint<Vec3d>>().multipliers;
  REQUIRE(f.size() == 3);
  CHECK(f[2] == Approx(6 * 0.5 * 10));  // all weights
  CHECK(by.warnings().list().empty());
  CHECK_THAT(error_of([&] { chain(Solver{}, true); }),
             Catch::Contains("PreconditionedConjugateResidual") && Catch::Contains("equalities only") &&
                 Catch::Contains("equation 0 of /root/chain: UnilateralLagrangianConstraint"));
}

}  // namespace test_preconditioned_conjugate_residual
