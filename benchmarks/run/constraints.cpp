// SPDX-License-Identifier: BSL-1.0
// One step with contacts: ConvexStep, cold and with the multipliers of the step before, against block
// Gauss-Seidel on W = J A^-1 J'. The time to make W is that of a sparse factor, one right-hand side for each
// row, and a product. Both go on until the natural map of the friction problem is below 1e-6 m/s.
//   bench_constraints [large]
#include "lagrangian/bodies.hpp"
#include "lagrangian/soft_block.hpp"

#include <sinew/lagrangian/constraint_sweeps.hpp>

#include <chrono>
#include <cstdio>
#include <string>

namespace {

using namespace sinew;

constexpr double tolerance = 1e-6, patience = 20;  // m/s, s

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void sweep(ConstraintProblem& problem, double made) {
  ConstraintSweeps sweeps;
  const double start = seconds();
  int count = 0;
  double residual = problem.residual();
  while (residual > tolerance && seconds() - start < patience) {
    count += sweeps.gaussSeidel(problem, {.maxIterations = count + 1, .tolerance = 0}, "bench").iterations;
    residual = problem.residual();
  }
  std::printf(" | %9.1f %6d %9.1f %8.1e", 1e3 * made, count, 1e3 * (seconds() - start), residual);
}

// the fastest of three
template <class Solve>
void report(Solve&& solve) {
  double best = 1e9;
  ConvexStepResult result;
  for (int i = 0; i < 3; ++i) {
    const double start = seconds();
    result = solve();
    best = std::min(best, seconds() - start);
  }
  std::printf(" | %3d %4d %5d %9.1f%s",
              result.updates,
              result.newtonIterations,
              result.conjugateGradients,
              1e3 * best,
              result.converged ? " " : "!");
}

// the step, and one from its multipliers to a free motion that differs by 1 %
template <class Step>
void solvers(Step&& step, Eigen::VectorXd const& free, Eigen::Index rows) {
  Eigen::VectorXd v, f;
  report([&] {
    v = free;
    f = Eigen::VectorXd::Zero(rows);
    return step(free, v, f);
  });
  const Eigen::VectorXd next = 1.01 * free, velocity = v, multipliers = f;
  report([&] {
    v = velocity;
    f = multipliers;
    return step(next, v, f);
  });
}

void soft(soft_block::Settings const& settings, double stiffness) {
  soft_block::Settings s = settings;
  s.young *= stiffness;
  const soft_block::Problem p = soft_block::make(s);
  std::printf("%d soft, %6d tetrahedra, E x %-6g mu %.1f, %4zu contacts",
              s.count,
              6 * s.nx * s.ny * s.nz * s.count,
              stiffness,
              s.mu,
              p.blocks.size());
  ConvexStep engine;
  ConstrainedBlockJacobi<3> preconditioner;
  preconditioner.system = p.diagonal;
  ConvexStepSettings convex;
  convex.tolerance = tolerance;
  solvers(
      [&](Eigen::VectorXd const& free, Eigen::VectorXd& v, Eigen::VectorXd& f) {
        return engine.solve([&](Eigen::VectorXd const& x, Eigen::VectorXd& y) { y.noalias() = p.A * x; },
                            preconditioner,
                            p.A * free,
                            p.rows,
                            p.blocks,
                            p.start,
                            v,
                            f,
                            convex,
                            "bench");
      },
      p.free,
      p.start.size());

  const double start = seconds();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(Eigen::SparseMatrix<double>(p.A));
  const Eigen::SparseMatrix<double> J = soft_block::jacobian(p);
  ConstraintProblem problem;
  problem.compliance.resize(J.rows(), J.rows());
  for (Eigen::Index first = 0; first < J.rows(); first += 192) {
    const Eigen::Index n = std::min<Eigen::Index>(192, J.rows() - first);
    const Eigen::MatrixXd right = Eigen::MatrixXd(J.middleRows(first, n)).transpose();
    problem.compliance.middleCols(first, n) = J * factor.solve(right);
  }
  problem.freeViolation = J * p.free + p.start;
  problem.multipliers = Eigen::VectorXd::Zero(J.rows());
  problem.blocks = p.blocks;
  sweep(problem, seconds() - start);
  std::printf("\n");
}

void rigid(std::string const& name, rigid_bodies::Bodies<6> const& p) {
  std::printf("%-46s %5zu contacts", name.c_str(), p.blocks.size());
  ConvexStep engine;
  ConstrainedBlockJacobi<6> preconditioner;
  preconditioner.system = p.mass;
  ConvexStepSettings convex;
  convex.tolerance = tolerance;
  Eigen::VectorXd b = p.free;
  solvers(
      [&](Eigen::VectorXd const& free, Eigen::VectorXd& v, Eigen::VectorXd& f) {
        p.multiply(free, b);
        return engine.solve([&](Eigen::VectorXd const& x, Eigen::VectorXd& y) { p.multiply(x, y); },
                            preconditioner,
                            b,
                            p.rows,
                            p.blocks,
                            p.start,
                            v,
                            f,
                            convex,
                            "bench");
      },
      p.free,
      p.start.size());
  const double start = seconds();
  ConstraintProblem problem = p.problem();
  sweep(problem, seconds() - start);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-62s | %-25s | %-25s | Gauss-Seidel on W\n", "", "cold", "warm");
  std::printf(
      "%-62s | upd newt    cg        ms  | upd newt    cg        ms  |      W ms sweeps        ms residual\n",
      "");
  if (argc > 1 && std::string(argv[1]) == "large") {
    for (const double stiffness : {1., 100., 1e4})
      soft({.nx = 32, .ny = 32, .nz = 3, .size = 0.1 / 32, .mu = 0.5}, stiffness);
    return 0;
  }
  for (const int count : {1, 2})
    for (const double stiffness : {1., 100., 1e4})
      for (const double mu : {0., 0.5, 1.})
        soft({.nx = 9, .ny = 9, .nz = 4, .count = count, .mu = mu}, stiffness);
  soft({.nx = 21, .ny = 21, .nz = 1, .size = 0.1 / 21}, 1);
  for (const int height : {5, 10, 20}) {
    rigid("wall of " + std::to_string(height) + " x 5 bricks, mu 0.6", rigid_bodies::wall(height, 5, 0.6));
    rigid("the same, one pushed out at 0.5 m/s", rigid_bodies::wall(height, 5, 0.6, 0.5));
  }
}
