// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>

#include <Eigen/Cholesky>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// When the iterations over the blocks of constraints end.
struct SweepSettings {
  int maxIterations = 1000;
  /// Of the sum over the rows i of sqrt(sum_j (W_ij (f_j - f_j before))^2), j in the block of i, in the unit
  /// of the violation.
  double tolerance = 1e-3;
  bool scaleTolerance = true;  // times the number of rows
  bool allVerified = false;    // no row may change by more than the tolerance, instead of the sum
  double relaxation = 1;       // sor: f = sor f + (1 - sor) f before
};

struct SweepResult {
  int iterations = 0;
  double error = 0;  // what the tolerance is compared with
  bool converged = true;
};

/// Iterations over the blocks of a problem. Between them nothing is kept but room, so that one object serves
/// a scene for all its steps.
class ConstraintSweeps {
 public:
  /// Block Gauss-Seidel: each block in turn is solved for its own multipliers, those of the others as they
  /// are (Duriez et al. 2006, for contacts with friction).
  SweepResult gaussSeidel(ConstraintProblem& problem, SweepSettings const& settings, std::string_view where);

  /// Nonsmooth nonlinear conjugate gradients: a sweep of Gauss-Seidel takes the place of the gradient
  /// (Silcowitz, Niebe, Erleben 2010).
  SweepResult nonsmoothConjugateGradients(ConstraintProblem& problem, SweepSettings const& settings,
                                          std::string_view where);

  /// Projected Jacobi: all blocks are solved with the multipliers of the last iteration, their violations
  /// weighed by `weight`. It converges where `weight` times the largest eigenvalue of D^-1 W is below 2.
  SweepResult jacobi(ConstraintProblem& problem, SweepSettings const& settings, double weight,
                     std::string_view where);

 private:
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, ConstraintBlock::maxRows,
                              ConstraintBlock::maxRows>;
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, ConstraintBlock::maxRows, 1>;

  std::vector<Small> inverses_{};  // of W_bb, for equalities
  ReservedVector last_{}, change_{}, direction_{}, violation_{};

  void begin(ConstraintProblem const& problem, std::string_view where);
  static double limit(ConstraintProblem const& problem, SweepSettings const& settings) {
    return settings.scaleTolerance && !settings.allVerified ? settings.tolerance * problem.rows()
                                                            : settings.tolerance;
  }
  // f of a block from the violation d that it has with all multipliers as they are
  // `weight`: of the violation, and so of the ends of intervals
  void solveBlock(ConstraintProblem& problem, std::size_t number, Few& d, double weight = 1) const;

  struct Change {
    double sum = 0, largest = 0;  // over blocks; of one row
  };
  // what is left of the problem by this change, into the result
  static void judge(SweepResult& result, Change const& change, ConstraintProblem const& problem,
                    SweepSettings const& settings) {
    result.error = settings.allVerified ? change.largest : change.sum;
    result.converged = result.error <= limit(problem, settings);
  }
  static void add(Change& change, ConstraintProblem const& problem, ConstraintBlock const& block,
                  Few const& step);
  Change sweep(ConstraintProblem& problem) const;
};

inline void ConstraintSweeps::begin(ConstraintProblem const& problem, std::string_view where) {
  problem.check(where);
  inverses_.resize(problem.blocks.size());
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    ConstraintBlock const& b = problem.blocks[k];
    if (b.kind != ConstraintBlock::Kind::equality) continue;
    const Small w = problem.compliance.block(b.first, b.first, b.rows, b.rows);
    const Eigen::LDLT<Small> factor(w);
    const Few pivots = factor.vectorD();
    if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff()))
      throw Error(where,
                  text("the equalities in rows ",
                       b.first,
                       " to ",
                       b.first + b.rows - 1,
                       " depend on each other, so that their multipliers are not determined; leave one out"));
    // column by column, since nvcc takes Eigen's solution for a matrix for a function of the device
    inverses_[k].resize(b.rows, b.rows);
    for (int c = 0; c < b.rows; ++c) inverses_[k].col(c) = factor.solve(Few(Few::Unit(b.rows, c)));
  }
}

inline void ConstraintSweeps::solveBlock(ConstraintProblem& problem, std::size_t number, Few& d,
                                         double weight) const {
  ConstraintBlock const& b = problem.blocks[number];
  auto const& W = problem.compliance;
  auto& f = problem.multipliers;
  const int i = b.first;
  switch (b.kind) {
    case ConstraintBlock::Kind::equality:
      f.segment(i, b.rows) -= inverses_[number] * d;
      break;
    case ConstraintBlock::Kind::interval: {
      const double without = d[0] - W(i, i) * f[i];
      f[i] = (std::clamp(without, weight * b.lower, weight * b.upper) - without) / W(i, i);
      break;
    }
    case ConstraintBlock::Kind::friction: {
      // first along the normal, then along the tangents by the mean of their compliances, then back onto the
      // cone
      const double before = f[i];
      f[i] -= d[0] / W(i, i);
      if (f[i] < 0) {
        f.segment<3>(i).setZero();
        break;
      }
      const double tangential = (W(i + 1, i + 1) + W(i + 2, i + 2)) / 2;
      for (int t = 1; t <= 2; ++t) f[i + t] -= (d[t] + W(i + t, i) * (f[i] - before)) / tangential;
      const double held = std::hypot(f[i + 1], f[i + 2]), allowed = b.friction * f[i];
      if (held > allowed) f.segment<2>(i + 1) *= allowed / held;
      break;
    }
  }
}

inline void ConstraintSweeps::add(Change& change, ConstraintProblem const& problem, ConstraintBlock const& b,
                                  Few const& step) {
  for (int l = 0; l < b.rows; ++l) {
    const double row =
        (problem.compliance.row(b.first + l).segment(b.first, b.rows).transpose().array() * step.array())
            .matrix()
            .norm();
    change.sum += row;
    change.largest = std::max(change.largest, row);
  }
}

inline ConstraintSweeps::Change ConstraintSweeps::sweep(ConstraintProblem& problem) const {
  Change change;
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    ConstraintBlock const& b = problem.blocks[k];
    const Few before = problem.multipliers.segment(b.first, b.rows);
    Few d = problem.freeViolation.segment(b.first, b.rows);
    d.noalias() += problem.compliance.middleRows(b.first, b.rows) * problem.multipliers;
    solveBlock(problem, k, d);
    add(change, problem, b, problem.multipliers.segment(b.first, b.rows) - before);
  }
  return change;
}

inline SweepResult ConstraintSweeps::gaussSeidel(ConstraintProblem& problem, SweepSettings const& settings,
                                                 std::string_view where) {
  begin(problem, where);
  SweepResult result;
  if (problem.rows() == 0) return result;
  result.converged = false;
  while (result.iterations < settings.maxIterations && !result.converged) {
    if (settings.relaxation != 1) last_ = problem.multipliers;
    const Change change = sweep(problem);
    if (settings.relaxation != 1)
      problem.multipliers = settings.relaxation * problem.multipliers + (1 - settings.relaxation) * last_;
    ++result.iterations;
    judge(result, change, problem, settings);
  }
  return result;
}

inline SweepResult ConstraintSweeps::nonsmoothConjugateGradients(ConstraintProblem& problem,
                                                                 SweepSettings const& settings,
                                                                 std::string_view where) {
  begin(problem, where);
  SweepResult result;
  if (problem.rows() == 0) return result;
  last_ = problem.multipliers;
  judge(result, sweep(problem), problem, settings);
  result.iterations = 1;
  change_ = problem.multipliers - last_;  // minus the gradient
  direction_ = change_;
  double squared = change_.squaredNorm();
  while (result.iterations < settings.maxIterations && !result.converged) {
    last_ = problem.multipliers;
    const Change change = sweep(problem);
    ++result.iterations;
    judge(result, change, problem, settings);
    if (result.converged || result.iterations == settings.maxIterations) break;  // both end with a sweep
    change_ = problem.multipliers - last_;
    const double next = change_.squaredNorm(), beta = next / squared;
    squared = next;
    if (beta > 1) {
      direction_.setZero();  // begins anew
    } else {
      problem.multipliers += beta * direction_;
      direction_ = beta * direction_ + change_;
    }
  }
  return result;
}

inline SweepResult ConstraintSweeps::jacobi(ConstraintProblem& problem, SweepSettings const& settings,
                                            double weight, std::string_view where) {
  begin(problem, where);
  SweepResult result;
  if (problem.rows() == 0) return result;
  result.converged = false;
  while (result.iterations < settings.maxIterations && !result.converged) {
    violation_ = problem.freeViolation;
    violation_.noalias() += problem.compliance * problem.multipliers;
    Change change;
    for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
      ConstraintBlock const& b = problem.blocks[k];
      const Few before = problem.multipliers.segment(b.first, b.rows);
      Few d = weight * violation_.segment(b.first, b.rows);
      solveBlock(problem, k, d, weight);
      add(change, problem, b, problem.multipliers.segment(b.first, b.rows) - before);
    }
    ++result.iterations;
    judge(result, change, problem, settings);
  }
  return result;
}

}  // namespace sinew
