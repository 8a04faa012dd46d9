// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_sweeps.hpp>
#include <sinew/lagrangian/lemke.hpp>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// Solves the constraints of a problem by Lemke's method. Equalities are eliminated, intervals have a
/// multiplier for each end; contacts have no friction, and blocks with mu > 0 are an Error.
/// Where there is no solution, multipliers are 0 and the result has not converged; its error is that of
/// ConstraintProblem::residual(), its iterations are pivots.
class LinearComplementarity {
 public:
  SweepResult solve(ConstraintProblem& problem, std::string_view where);

 private:
  struct End {
    int row;
    double sign, bound;  // sign (d - bound) >= 0
  };
  Lemke lemke_{};
  std::vector<End> ends_{};
  std::vector<int> equalities_{};
  Reserved<Eigen::MatrixXd> M_{}, coupling_{};
  Eigen::MatrixXd eliminated_{};  // by equalities
  ReservedVector q_{}, z_{};
};

/// What SOFA's LCPConstraintSolver has as fields. Its violations and multipliers are an impulse's; here
/// multipliers are forces.
struct ComplementaritySettings {
  int maxIterations = 1000;  // maxIt
  /// Of sum |W_bb step_b| over the blocks: times their number and one more where contacts have friction, as
  /// it is where none has.
  double tolerance = 1e-3;
  bool initialGuess = true;  // multipliers as they are, else 0
  double minW = 0;           // constraints of a compliance [m/N] up to that have no force; 0: none
  double maxF = 0;           // contacts whose normal force [N] ends at that or above lose it; 0: none
};

/// SOFA's LCPConstraintSolver: block Gauss-Seidel as ConstraintSweeps has it, with a measure of errors of its
/// own. As there, with friction a force is compared with maxF only if the iterations have converged.
/// Equalities, which SOFA's takes for contacts, are solved as they are; minW and maxF are not for them.
class ComplementaritySweeps {
 public:
  SweepResult solve(ConstraintProblem& problem, ComplementaritySettings const& settings,
                    std::string_view where);

 private:
  std::vector<BlockMatrix> inverses_{};  // of W_bb, for equalities
  std::vector<char> ignored_{};
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/LU>

namespace sinew {

SINEW_ONCE SweepResult LinearComplementarity::solve(ConstraintProblem& problem, std::string_view where) {
  problem.check(where);
  ends_.clear();
  equalities_.clear();
  for (ConstraintBlock const& b : problem.blocks) switch (b.kind) {
      case ConstraintBlock::Kind::equality:
        for (int i = 0; i < b.rows; ++i) equalities_.push_back(b.first + i);
        break;
      case ConstraintBlock::Kind::interval:
        if (std::isfinite(b.lower)) ends_.push_back({b.first, 1, b.lower});
        if (std::isfinite(b.upper)) ends_.push_back({b.first, -1, b.upper});
        break;
      case ConstraintBlock::Kind::friction:
        if (b.friction > 0)
          throw Error(where,
                      text("Lemke's method is for contacts without friction, and that at row ",
                           b.first,
                           " has ",
                           b.friction,
                           "; set mu to 0, or solve by Gauss-Seidel"));
        ends_.push_back({b.first, 1, 0});
        break;
    }
  const auto n = Eigen::Index(ends_.size()), m = Eigen::Index(equalities_.size());
  auto const& W = problem.compliance;
  auto& f = problem.multipliers;
  f.setZero();

  // what an end does to an end, and equalities to both: f_e = -W_ee^-1 (d_e + W_ec f_c)
  M_.resize(n, n);
  q_.resize(n);
  coupling_.resize(m, n + 1);  // W_ec, d_e
  for (Eigen::Index j = 0; j < n; ++j) {
    const End end = ends_[std::size_t(j)];
    q_[j] = end.sign * (problem.freeViolation[end.row] - end.bound);
    for (Eigen::Index i = 0; i < n; ++i)
      M_(i, j) = ends_[std::size_t(i)].sign * end.sign * W(ends_[std::size_t(i)].row, end.row);
    for (Eigen::Index e = 0; e < m; ++e) coupling_(e, j) = end.sign * W(equalities_[std::size_t(e)], end.row);
  }
  if (m > 0) {
    Eigen::MatrixXd equal(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
      const int row = equalities_[std::size_t(j)];
      coupling_(j, n) = problem.freeViolation[row];
      for (Eigen::Index i = 0; i < m; ++i) equal(i, j) = W(equalities_[std::size_t(i)], row);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> factor(equal);
    if (!factor.isInvertible())
      throw Error(
          where,
          text(m - factor.rank(),
               " of the ",
               m,
               " equalities depend on the others, so that their multipliers are not determined; leave "
               "them out, or add to their compliance (regularizationTerm)"));
    // column by column, since nvcc takes Eigen's solution for a matrix for a function of the device
    eliminated_.resize(m, n + 1);
    Eigen::VectorXd column(m);
    for (Eigen::Index c = 0; c <= n; ++c) {
      column = factor.solve(Eigen::VectorXd(coupling_.col(c)));
      eliminated_.col(c) = column;
      if (c < n)
        M_.col(c).noalias() -= coupling_.leftCols(n).transpose() * column;
      else
        q_.noalias() -= coupling_.leftCols(n).transpose() * column;
    }
  }

  SweepResult result;
  const Lemke::End end = lemke_.solve(M_, q_, z_, 50 * int(n) + 50);
  result.iterations = lemke_.pivots;
  result.converged = end == Lemke::End::solved;
  if (result.converged) {
    for (Eigen::Index j = 0; j < n; ++j) f[ends_[std::size_t(j)].row] += ends_[std::size_t(j)].sign * z_[j];
    for (Eigen::Index e = 0; e < m; ++e)
      f[equalities_[std::size_t(e)]] = -eliminated_(e, n) - eliminated_.row(e).head(n).dot(z_);
  }
  result.error = problem.rows() > 0 ? problem.residual() : 0;
  // pivots of bases that hardly differ from singular ones may have lost what was to be found
  if (result.error > 1e-6 * problem.freeViolation.lpNorm<Eigen::Infinity>()) result.converged = false;
  return result;
}

SINEW_ONCE SweepResult ComplementaritySweeps::solve(ConstraintProblem& problem,
                                                    ComplementaritySettings const& settings,
                                                    std::string_view where) {
  problem.checkSizes(where);
  SweepResult result;
  auto& f = problem.multipliers;
  if (!settings.initialGuess) f.setZero();
  ignored_.assign(problem.blocks.size(), 0);
  inverses_.resize(problem.blocks.size());
  bool rubs = false;
  double scale = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    ConstraintBlock const& b = problem.blocks[k];
    rubs = rubs || (b.kind == ConstraintBlock::Kind::friction && b.friction > 0);
    BlockMatrix const w = problem.own(b);
    const bool equal = b.kind == ConstraintBlock::Kind::equality;
    ignored_[k] = !equal && settings.minW > 0 && std::abs(w(0, 0)) <= settings.minW;
    if (ignored_[k]) {
      f.segment(b.first, b.rows).setZero();
      continue;
    }
    check_movable(w.diagonal(), where, b.first);
    if (equal) inverses_[k] = inverse_compliance(w, b, where);
    scale += size_of_block(b, w, problem.freeViolation.segment(b.first, b.rows), f.segment(b.first, b.rows));
  }
  if (problem.blocks.empty()) return result;
  problem.multipliersSet();

  const double limit = settings.tolerance * (rubs ? double(problem.blocks.size() + 1) : 1.);
  result.converged = false;
  while (result.iterations < settings.maxIterations && !result.converged) {
    SweepChange change;
    for (std::size_t k = 0; k < problem.blocks.size(); ++k)
      if (!ignored_[k]) relax_block(problem, problem.blocks[k], inverses_[k], change);
    ++result.iterations;
    if (runs_away(result, change.blocks, scale, f)) return result;
    result.error = change.blocks;
    result.converged = result.error <= limit;
  }
  if (settings.maxF > 0 && (result.converged || !rubs))
    for (ConstraintBlock const& b : problem.blocks)
      if (b.kind != ConstraintBlock::Kind::equality && std::abs(f[b.first]) >= settings.maxF)
        f.segment(b.first, b.rows).setZero();
  return result;
}

}  // namespace sinew
#endif
