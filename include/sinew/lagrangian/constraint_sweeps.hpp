// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/block_solve.hpp>

#include <cmath>
#include <limits>
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

  double limit(Eigen::Index rows) const {
    return scaleTolerance && !allVerified ? tolerance * double(rows) : tolerance;
  }
};

struct SweepResult {
  int iterations = 0;
  double error = 0;  // what the tolerance is compared with; infinite where the iterations have run away
  bool converged = true;
};

/// How Jacobi's iteration goes from all violations to the next multipliers.
struct JacobiSettings {
  double weight = 1;  // of the violations
  /// The last change is added to the next one, times (i / maxIterations)^delay in iteration i (Francu,
  /// Moldoveanu 2014; SOFA's conjugateResidueSpeedFactor); none where it is infinite.
  double delay = std::numeric_limits<double>::infinity();
};

/// Whether the iterations diverge: a block changes by so much more than what there is to correct. Then the
/// multipliers are set to zero, which all conditions but equalities permit, and the error to infinity.
bool runs_away(SweepResult& result, double change, double scale, Eigen::Ref<Eigen::VectorXd> multipliers);

/// Largest eigenvalue of D^-1 W by power iterations, from below to about 1e-3 of it; W and D are symmetric
/// and positive, and `solve` is D^-1.
class LargestEigenvalue {
 public:
  template <class Matrix, class Solve>
  double operator()(Matrix const& W, Solve&& solve) {
    const auto n = W.rows();
    x_.resize(n);
    y_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) x_[i] = std::sin(1 + 12.9898 * double(i));  // orthogonal to nothing
    double value = 0;
    for (int k = 0; k < 1000; ++k) {
      y_.noalias() = W * x_;
      solve(y_);
      const double norm = y_.norm() / x_.norm();
      if (!(norm > 0) || !std::isfinite(norm)) return 0;
      x_ = y_ / y_.norm();
      if (k > 10 && std::abs(norm - value) <= 1e-6 * norm) return norm;
      value = norm;
    }
    return value;
  }

 private:
  ReservedVector x_{}, y_{};
};

/// SOFA's weight of Jacobi (useSpectralCorrection): factor min(1, 1.8 / the largest eigenvalue of W), which
/// depends on the unit of W: it is SOFA's, in which multipliers are impulses.
double spectral_weight(ConstraintProblem const& problem, double factor, LargestEigenvalue& largest);
double spectral_weight(ConstraintProblem const& problem, double factor);

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
  /// weighed. It converges where the weight times the largest eigenvalue of D^-1 W is below 2.
  /// What the tolerance is compared with is here the sum over the blocks of sqrt(sum_ik (W_ik step_k)^2), i
  /// in the block, k over all rows, with the new steps up to the block and the last ones behind it, as SOFA
  /// has it; and with allVerified each of these, not each row.
  SweepResult jacobi(ConstraintProblem& problem, SweepSettings const& settings,
                     JacobiSettings const& jacobiSettings, std::string_view where);
  SweepResult jacobi(ConstraintProblem& problem, SweepSettings const& settings, double weight,
                     std::string_view where) {
    return jacobi(problem, settings, JacobiSettings{.weight = weight}, where);
  }

 private:
  std::vector<BlockMatrix> inverses_{};  // of W_bb, for equalities
  ReservedVector last_{}, change_{}, direction_{}, violation_{}, steps_{}, behind_{};
  double scale_ = 0;  // what there is to correct

  void begin(ConstraintProblem& problem, std::string_view where);
  // what is left of the problem by this change, into the result; whether to go on
  bool judge(SweepResult& result, SweepChange const& change, ConstraintProblem& problem,
             SweepSettings const& settings) const;
  SweepChange sweep(ConstraintProblem& problem) const {
    SweepChange change;
    for (std::size_t k = 0; k < problem.blocks.size(); ++k)
      relax_block(problem, problem.blocks[k], inverses_[k], change);
    return change;
  }
  SweepChange product(ConstraintProblem const& problem);
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE bool runs_away(SweepResult& result, double change, double scale,
                          Eigen::Ref<Eigen::VectorXd> multipliers) {
  if (change <= 1e9 * scale && multipliers.allFinite()) return false;
  multipliers.setZero();
  result.error = std::numeric_limits<double>::infinity();
  result.converged = false;
  return true;
}

SINEW_ONCE double spectral_weight(ConstraintProblem const& problem, double factor,
                                  LargestEigenvalue& largest) {
  const double radius = largest(problem.compliance, [](auto&) {}) / problem.timeStep;
  return factor * (radius > 0 ? std::min(1., 1.8 / radius) : 1);
}

SINEW_ONCE double spectral_weight(ConstraintProblem const& problem, double factor) {
  LargestEigenvalue largest;
  return spectral_weight(problem, factor, largest);
}

SINEW_ONCE bool ConstraintSweeps::judge(SweepResult& result, SweepChange const& change,
                                        ConstraintProblem& problem, SweepSettings const& settings) const {
  if (runs_away(result, change.rows, scale_, problem.multipliers)) return false;
  result.error = settings.allVerified ? change.largest : change.rows;
  result.converged = result.error <= settings.limit(problem.rows());
  return !result.converged && result.iterations < settings.maxIterations;
}

SINEW_ONCE void ConstraintSweeps::begin(ConstraintProblem& problem, std::string_view where) {
  problem.check(where);
  problem.multipliersSet();
  inverses_.resize(problem.blocks.size());
  scale_ = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    ConstraintBlock const& b = problem.blocks[k];
    BlockMatrix const w = problem.own(b);
    if (b.kind == ConstraintBlock::Kind::equality) inverses_[k] = inverse_compliance(w, b, where);
    scale_ += size_of_block(
        b, w, problem.freeViolation.segment(b.first, b.rows), problem.multipliers.segment(b.first, b.rows));
  }
}

SINEW_ONCE SweepResult ConstraintSweeps::gaussSeidel(ConstraintProblem& problem,
                                                     SweepSettings const& settings, std::string_view where) {
  begin(problem, where);
  SweepResult result;
  if (problem.rows() == 0) return result;
  result.converged = false;
  bool goesOn = settings.maxIterations > 0;
  while (goesOn) {
    if (settings.relaxation != 1) last_ = problem.multipliers;
    const SweepChange change = sweep(problem);
    if (settings.relaxation != 1) {
      problem.multipliers = settings.relaxation * problem.multipliers + (1 - settings.relaxation) * last_;
      problem.multipliersSet();
    }
    ++result.iterations;
    goesOn = judge(result, change, problem, settings);
  }
  return result;
}

SINEW_ONCE SweepResult ConstraintSweeps::nonsmoothConjugateGradients(ConstraintProblem& problem,
                                                                     SweepSettings const& settings,
                                                                     std::string_view where) {
  begin(problem, where);
  SweepResult result;
  if (problem.rows() == 0) return result;
  last_ = problem.multipliers;
  result.iterations = 1;
  if (!judge(result, sweep(problem), problem, settings)) return result;
  change_ = problem.multipliers - last_;  // minus the gradient
  direction_ = change_;
  double squared = change_.squaredNorm();
  while (true) {
    last_ = problem.multipliers;
    const SweepChange change = sweep(problem);
    ++result.iterations;
    if (!judge(result, change, problem, settings)) return result;  // all ends are behind a sweep
    change_ = problem.multipliers - last_;
    const double next = change_.squaredNorm(), beta = next / squared;
    squared = next;
    if (!(beta <= 1)) {
      direction_.setZero();  // begins anew
    } else {
      problem.multipliers += beta * direction_;
      direction_ = beta * direction_ + change_;
    }
  }
}

// d += W steps, and how much that is
SINEW_ONCE SweepChange ConstraintSweeps::product(ConstraintProblem const& problem) {
  SweepChange change;
  for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
    ConstraintBlock const& b = problem.blocks[k];
    const auto end = b.first + b.rows;
    double squared = behind_[Eigen::Index(k)], behind = 0;
    for (int i = b.first; i < end; ++i) {
      auto const w = problem.compliance.row(i).transpose().array();
      violation_[i] += (w * steps_.array()).sum();
      squared += (w.head(end) * steps_.array().head(end)).square().sum();
      behind += (w.tail(problem.rows() - end) * steps_.array().tail(problem.rows() - end)).square().sum();
    }
    behind_[Eigen::Index(k)] = behind;
    change.rows += std::sqrt(squared);
    change.largest = std::max(change.largest, std::sqrt(squared));
  }
  return change;
}

SINEW_ONCE SweepResult ConstraintSweeps::jacobi(ConstraintProblem& problem, SweepSettings const& settings,
                                                JacobiSettings const& jacobiSettings,
                                                std::string_view where) {
  begin(problem, where);
  if (!(jacobiSettings.weight > 0) || !std::isfinite(jacobiSettings.weight) || !(jacobiSettings.delay >= 0))
    throw Error(where,
                text("Jacobi's iteration has the weight ",
                     jacobiSettings.weight,
                     " and the delay ",
                     jacobiSettings.delay,
                     "; the weight is positive and finite, the delay at least 0"));
  SweepResult result;
  if (problem.rows() == 0) return result;
  result.converged = false;
  violation_ = problem.freeViolation;
  violation_.noalias() += problem.compliance * problem.multipliers;
  steps_.setZero(problem.rows());
  behind_.setZero(Eigen::Index(problem.blocks.size()));
  const double weight = jacobiSettings.weight;
  double momentum = 0;
  bool goesOn = settings.maxIterations > 0;
  while (goesOn) {
    momentum = std::isfinite(jacobiSettings.delay)
                   ? std::pow(double(result.iterations) / settings.maxIterations, jacobiSettings.delay)
                   : 0;
    for (std::size_t k = 0; k < problem.blocks.size(); ++k) {
      ConstraintBlock const& b = problem.blocks[k];
      auto f = problem.multipliers.segment(b.first, b.rows);
      auto step = steps_.segment(b.first, b.rows);
      const BlockVector before = f;
      BlockVector next = before;
      solve_block(b,
                  problem.compliance.block(b.first, b.first, b.rows, b.rows),
                  inverses_[k],
                  weight * violation_.segment(b.first, b.rows),
                  next,
                  weight);
      f = next + momentum * step;
      step = f - before;
    }
    ++result.iterations;
    goesOn = judge(result, product(problem), problem, settings);
    if (result.converged && result.iterations == 1 && !settings.allVerified) {
      // as SOFA does; but what has no step at all has no other next
      result.converged = result.error == 0 || settings.maxIterations == 1;
      goesOn = !result.converged;
    }
  }
  if (momentum > 0)  // it may have led out of what is permitted
    for (ConstraintBlock const& b : problem.blocks) {
      auto f = problem.multipliers.segment(b.first, b.rows);
      if (b.kind == ConstraintBlock::Kind::friction) {
        auto contact = problem.multipliers.segment<3>(b.first);
        contact = project_on_cone(contact, b.friction);
      }
      if (b.kind != ConstraintBlock::Kind::interval) continue;
      if (!std::isfinite(b.upper)) f[0] = std::max(0., f[0]);
      if (!std::isfinite(b.lower)) f[0] = std::min(0., f[0]);
    }
  return result;
}

}  // namespace sinew
#endif
