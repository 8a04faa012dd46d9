// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/solver/min_res_linear_solver.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace test_krylov_solvers {

using namespace sinew;

namespace {

using Matrix3d = CompressedRowSparseMatrixMat3x3d;

struct Run {
  Eigen::VectorXd velocities;
  std::vector<double> residuals;
  int iterations() const { return int(residuals.size()) - 1; }
};
template <class Linear>
Run run(Linear linear, bool graded = false, int cells = 8) {
  linear.iterations = 3000;
  auto sim = fem_bar::simulation(linear, cells, true, graded);
  return {fem_bar::velocities(sim), sim.root().template get<Linear>().residuals};
}
Eigen::VectorXd direct(bool graded = false) {
  auto sim = fem_bar::simulation(SparseLDLSolver<>{}, 8, true, graded);
  return fem_bar::velocities(sim);
}

}  // namespace

TEST_CASE("a threshold that keeps a light body from moving is warned of") {
  auto fallen = [](double threshold) {
    RegistryScene sim{node<"root">(Gravity{{0, -10, 0}},
                                   EulerImplicitSolver{},
                                   CGLinearSolver<>{.threshold = threshold},
                                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                   UniformMass<Vec3d>{.totalMass = 1e-3})};
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(0.01);
    return std::pair(sim.warnings().list(), sim.root().state().velocity[0][1]);
  };
  // b = m g dt, p.A p = m b^2 = 1e-11
  const auto [warned, stays] = fallen(1.1e-11);
  REQUIRE(warned.size() == 1);
  CHECK_THAT(warned[0].text(),
             Catch::Contains("/root: the linear solver did not begin") && Catch::Contains("1.1e-11"));
  CHECK(warned[0].count == 1);
  CHECK(stays == 0);
  const auto [silent, falls] = fallen(0.9e-11);
  CHECK(silent.empty());
  CHECK(falls == Approx(-0.3));
}

TEST_CASE("conjugate gradients that start from the last solution begin nearer, and find the same") {
  const Eigen::VectorXd exact = direct();
  auto compare = [&]<class Linear>(Linear linear) {
    Linear warm = linear;
    warm.warmStart = true;
    const Run cold = run(linear), started = run(warm);
    CHECK((started.velocities - exact).norm() < 1e-9 * exact.norm());
    CHECK(cold.residuals.front() == 1);
    CHECK(started.residuals.front() < 0.9);
    // the tolerance is that of the right side
    CHECK(started.residuals.back() <= linear.tolerance);
    CHECK(started.residuals[std::size_t(started.iterations() - 1)] > linear.tolerance);
  };
  compare(CGLinearSolver<>{.tolerance = 1e-12});
  compare(CGLinearSolver<Matrix3d>{.tolerance = 1e-12});
  // a system that is solved already takes no iteration
  RegistryScene sim{node<"root">(EulerImplicitSolver{},
                                 CGLinearSolver<>{.tolerance = 1e-10, .warmStart = true},
                                 MechanicalObject<Vec1d>{{Vec1d::Coord(0.0)}},
                                 UniformMass<Vec1d>{.vertexMass = 2},
                                 ConstantForceField<Vec1d>{.forces = {Vec1d::Deriv(3.0)}})};
  sim.init();
  sim.animate(0.1);
  CHECK(sim.root().get<CGLinearSolver<>>().residuals.size() == 2);
  sim.animate(0.1);
  CHECK(sim.root().get<CGLinearSolver<>>().residuals.size() == 1);
  CHECK(sim.root().state().velocity[0][0] == Approx(0.3));
}

TEST_CASE("MINRES, matrix-free and assembled, finds what L D L' finds") {
  const Eigen::VectorXd exact = direct();
  const Run free = run(MinResLinearSolver<>{.tolerance = 1e-13}),
            formed = run(MinResLinearSolver<Matrix3d>{.tolerance = 1e-13});
  CHECK((free.velocities - exact).norm() < 1e-10 * exact.norm());
  CHECK((formed.velocities - exact).norm() < 1e-10 * exact.norm());
  CHECK(free.iterations() == Approx(formed.iterations()).margin(2));
  // the residual never grows, and conjugate gradients, in the same Krylov spaces, never have a smaller one
  const Run cg = run(CGLinearSolver<Matrix3d>{.tolerance = 1e-13});
  CHECK(std::is_sorted(formed.residuals.rbegin(), formed.residuals.rend()));
  for (int i = 0; i < std::min(formed.iterations(), cg.iterations()); ++i)
    if (cg.residuals[std::size_t(i)] >
        1.5e-8)  // sqrt(eps): below, Lanczos' vectors are not orthogonal (Paige 1980)
      CHECK(formed.residuals[std::size_t(i)] < cg.residuals[std::size_t(i)] * (1 + 1e-4));
}

TEST_CASE("the residual that MINRES reports is that of its solution, also of an indefinite system") {
  // a step so long that compressed springs make the system indefinite: a chain pressed to half its length,
  // free across
  const int n = 8;
  MechanicalObject<Vec2d> state;
  StiffSpringForceField<Vec2d> springs;
  for (int i = 0; i < n; ++i) {
    state.position.push_back({0.5 * i, 0});
    state.velocity.push_back({0, i == 0 || i + 1 == n ? 0 : std::sin(double(i))});
    if (i > 0) springs.springs.push_back({.first = i - 1, .second = i, .stiffness = 100, .length = 1});
  }
  auto step = [&](auto linear) {
    RegistryScene sim{node<"root">(EulerImplicitSolver{},
                                   linear,
                                   state,
                                   UniformMass<Vec2d>{.vertexMass = 1},
                                   springs,
                                   FixedConstraint<Vec2d>{.indices = {0, n - 1}})};
    sim.init();
    sim.animate(0.2);
    return sim;
  };
  auto sim = step(MinResLinearSolver<CompressedRowSparseMatrixd>{.iterations = 100, .tolerance = 1e-12});
  auto& solver = sim.root().get<MinResLinearSolver<CompressedRowSparseMatrixd>>();
  auto& s = solver.system;
  Eigen::MatrixXd a(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; ++i) {
    Eigen::VectorXd e = Eigen::VectorXd::Unit(2 * n + 1, i);
    s.matrix.multiply(e.data(), s.product.data());
    a.col(i) = s.product.head(2 * n);
  }
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues();
  CHECK(eigenvalues[0] < -1);
  CHECK(eigenvalues[2 * n - 1] > 1);
  const double residual = (s.b.head(2 * n) - a * s.x.head(2 * n)).norm() / s.b.norm();
  CHECK(residual < 2e-12);
  CHECK(solver.residuals.size() <= 2 * n - 4 + 3);  // dofs that move, and rounding
  // and in the middle of the way
  auto part = step(MinResLinearSolver<CompressedRowSparseMatrixd>{.iterations = 4, .tolerance = 0});
  auto& half = part.root().get<MinResLinearSolver<CompressedRowSparseMatrixd>>();
  REQUIRE(half.residuals.size() == 5);
  CHECK(half.residuals.back() ==
        Approx((s.b.head(2 * n) - a * half.system.x.head(2 * n)).norm() / s.b.norm()));
  CHECK(half.residuals.back() < 0.9);
  CHECK(half.residuals.back() > 1e-3);
}

TEST_CASE("preconditioned conjugate gradients find what L D L' finds, with any preconditioner") {
  const Eigen::VectorXd exact = direct();
  for (const auto method : {PreconditionerMethod::none,
                            PreconditionerMethod::jacobi,
                            PreconditionerMethod::blockJacobi,
                            PreconditionerMethod::ssor,
                            PreconditionerMethod::incompleteCholesky,
                            PreconditionerMethod::ldl}) {
    CHECK((run(ShewchukPCGLinearSolver<>{.tolerance = 1e-13, .precondition = method}).velocities - exact)
              .norm() < 1e-10 * exact.norm());
    CHECK((run(ShewchukPCGLinearSolver<Matrix3d>{.tolerance = 1e-13, .precondition = method}).velocities -
           exact)
              .norm() < 1e-10 * exact.norm());
    CHECK(
        (run(ShewchukPCGLinearSolver<CompressedRowSparseMatrixd>{.tolerance = 1e-13, .precondition = method})
             .velocities -
         exact)
            .norm() < 1e-10 * exact.norm());
  }
}

TEST_CASE("without a preconditioner they are conjugate gradients") {
  const Run cg = run(CGLinearSolver<Matrix3d>{.tolerance = 1e-6}),
            pcg = run(ShewchukPCGLinearSolver<Matrix3d>{.tolerance = 1e-6, .usePrecond = false});
  REQUIRE(cg.iterations() == pcg.iterations());
  for (int i = 0; i <= cg.iterations(); ++i)
    CHECK(pcg.residuals[std::size_t(i)] == Approx(cg.residuals[std::size_t(i)]).epsilon(1e-6));
}

TEST_CASE("preconditioners save iterations on a bar") {
  auto count = [&](PreconditionerMethod method, bool graded, int updateStep = 1) {
    return run(
               ShewchukPCGLinearSolver<Matrix3d>{
                   .tolerance = 1e-8, .updateStep = updateStep, .precondition = method},
               graded,
               12)
        .iterations();
  };
  const int cg = run(CGLinearSolver<Matrix3d>{.tolerance = 1e-8}, false, 12).iterations(),
            cgGraded = run(CGLinearSolver<Matrix3d>{.tolerance = 1e-8}, true, 12).iterations();
  using enum PreconditionerMethod;
  const int uniform[] = {count(none, false),
                         count(jacobi, false),
                         count(blockJacobi, false),
                         count(incompleteCholesky, false),
                         count(ssor, false),
                         count(ldl, false)},
            graded[] = {count(none, true),
                        count(jacobi, true),
                        count(blockJacobi, true),
                        count(incompleteCholesky, true),
                        count(ssor, true),
                        count(ldl, true)};
  INFO("CG " << cg << ", jacobi " << uniform[1] << ", blockJacobi " << uniform[2] << ", incompleteCholesky "
             << uniform[3] << ", ssor " << uniform[4] << ", ldl " << uniform[5]);
  INFO("graded: CG " << cgGraded << ", jacobi " << graded[1] << ", blockJacobi " << graded[2]
                     << ", incompleteCholesky " << graded[3] << ", ssor " << graded[4] << ", ldl "
                     << graded[5]);
  CHECK(uniform[0] == cg);
  CHECK(uniform[1] <= cg);
  CHECK(uniform[2] <= uniform[1]);
  CHECK(2 * uniform[3] < cg);
  CHECK(2 * graded[1] < cgGraded);
  CHECK(graded[2] <= graded[1]);
  CHECK(2 * graded[3] < graded[2]);
  CHECK(3 * uniform[4] < 2 * uniform[2]);
  CHECK(3 * graded[4] < 2 * graded[2]);
  // A itself: one iteration, two where rounding leaves more than the tolerance
  CHECK(uniform[5] <= 2);
  CHECK(graded[5] <= 2);
  // one that is three steps old still serves
  CHECK(count(incompleteCholesky, false, 0) <= uniform[3] + 2);
}

}  // namespace test_krylov_solvers
